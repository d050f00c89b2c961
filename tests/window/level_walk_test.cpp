// Somebody who only walks (no jump, no flying) gets from the start to every place, along the fly-through's way.
#include <gtest/gtest.h>

#include <cmath>

#include "support/command.h"
#include "support/walker.h"

namespace tyndall::test {
namespace {

TEST(Level, EveryPlaceIsReachedOnFoot) {
    Scene scene = load_gltf(level());
    const Animation path = *scene.find_animation("flythrough");
    const int camera = scene.find_camera("flythrough")->node;
    const auto on_path = [&](float time) {
        animate_one(scene, path, time);
        return glm::vec3(scene.nodes[static_cast<std::size_t>(camera)].world[3]);
    };
    animate(scene, 0);
    Player player(scene);
    constexpr double dt = 1.0 / 30;
    constexpr int patience = 90;  // frames without coming nearer
    auto place = path.places.begin();
    float time = 0;
    glm::vec3 target = on_path(0);
    float nearest = 1e9f;
    int waited = 0;
    while (place != path.places.end()) {
        for (; ground_distance(player.eye(), target) < 1; target = on_path(time += 0.1f)) {
            nearest = 1e9f;
            while (place != path.places.end() && time >= place->time) ++place;
            if (time > path.duration) break;
        }
        const float height = player.eye().y;
        ASSERT_FALSE(player.update(towards(player, target), dt, true))
            << "fell out of the level on the way to " << place->name;
        ASSERT_LT(std::abs(player.eye().y - height), 0.3f) << "a jerk on the way to " << place->name;
        const float distance = ground_distance(player.eye(), target);
        waited = distance < nearest - 0.01f ? 0 : waited + 1;
        nearest = std::min(nearest, distance);
        ASSERT_LT(waited, patience) << "stuck on the way to " << place->name << " with the eye at "
                                    << player.eye().x << ", " << player.eye().y << ", " << player.eye().z;
    }
}

}  // namespace
}  // namespace tyndall::test
