#include <gtest/gtest.h>

#include <algorithm>

#include "engine/scene/data_root.h"
#include "engine/scene/scene.h"

namespace tyndall {
namespace {

TEST(Level, HasTheSixPlacesAndWhatTheyNeed) {
    const Scene scene = load_gltf(data_root() / "assets/levels/abbey.glb");
    const Animation* path = scene.find_animation("flythrough");
    ASSERT_NE(path, nullptr);
    for (const char* place : {"LocalPM", "Close", "LocalLights", "Sun", "Depth", "Balance"}) {
        EXPECT_NE(scene.find_camera(place), nullptr) << place;
        const auto on_path = std::ranges::find(path->places, place, &Animation::Place::name);
        ASSERT_NE(on_path, path->places.end()) << place;
        EXPECT_LE(on_path->time, path->duration) << place;
    }
    EXPECT_NE(scene.find_camera("Glass"), nullptr);
    EXPECT_TRUE(std::ranges::any_of(scene.materials, &Material::alpha_blend)) << "panes and water";
    EXPECT_FALSE(scene.emitters.empty()) << "smoke";
    EXPECT_TRUE(scene.sun());
    EXPECT_GE(std::ranges::count_if(scene.lights, [](const Light& l) { return l.type != LightType::sun; }), 200);
    EXPECT_FALSE(scene.media.empty());
    EXPECT_TRUE(std::ranges::any_of(scene.materials, &Material::alpha_mask)) << "leaves";
    EXPECT_TRUE(std::ranges::any_of(scene.animations, [](const Animation& a) { return a.name != "flythrough"; }))
        << "a tree that moves";
}

TEST(Level, TheCameraPathPassesThroughItsPlaces) {
    // At a place's time the path stands where that place's camera stands, within a step.
    Scene scene = load_gltf(data_root() / "assets/levels/abbey.glb");
    const Animation path = *scene.find_animation("flythrough");
    ASSERT_FALSE(path.channels.empty());
    const auto walker = static_cast<std::size_t>(path.channels[0].node);
    for (const Animation::Place& place : path.places) {
        animate_one(scene, path, place.time);
        const Camera* camera = scene.find_camera(place.name);
        ASSERT_NE(camera, nullptr) << place.name;
        const glm::vec3 stands(scene.nodes[static_cast<std::size_t>(camera->node)].world[3]);
        EXPECT_LT(glm::distance(glm::vec3(scene.nodes[walker].world[3]), stands), 1.0f) << place.name;
    }
}

}  // namespace
}  // namespace tyndall
