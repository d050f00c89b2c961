// Bounded media: a fog bank seen from inside and outside, a smooth cube and a ragged cloud.
#include "tools/bench_scenes/parts.h"

namespace tyndall::bench_scenes {

Scene depths() {
    Scene scene = empty_scene("depths", 3.7f);
    add_ground(scene, 60.0f);
    Mesh m{"frame", {}, mat4(1.0f)};
    // An upright frame before the lamp, four openings by three.
    for (int i = 0; i < 5; ++i) {
        const float x = -2.0f + static_cast<float>(i);
        box(m, kWood, {x - 0.12f, 0.0f, -8.1f}, {x + 0.12f, 4.0f, -7.9f});
    }
    for (int i = 0; i < 3; ++i) {
        const float y = 1.0f + 1.3f * static_cast<float>(i);
        box(m, kWood, {-2.1f, y, -8.08f}, {2.1f, y + 0.25f, -7.92f});
    }
    for (const float z : {-4.0f, 0.0f, 4.0f, 8.0f}) {
        for (const float x : {-3.0f, 3.0f})
            box(m, kStone, {x - 0.25f, 0.0f, z - 0.25f}, {x + 0.25f, 3.5f, z + 0.25f});
    }
    box(m, kPlaster, {-6.0f, 0.0f, 12.0f}, {6.0f, 5.0f, 12.3f});
    scene.add_static(std::move(m));
    add_spot(
        scene,
        {.position = {0.0f, 3.2f, -11.0f}, .candela = 20'000.0f, .color = {1.0f, 0.86f, 0.64f}, .radius = 0.1f},
        {0.0f, 1.6f, 2.0f}, 30.0f, 40.0f);
    scene.media.push_back(box_medium({0.06f, 0.002f, 0.4f}, {0.0f, 3.0f, 0.0f}, {14.0f, 6.2f, 26.0f}, 0.6f));
    add_view(scene, {0.6f, 1.7f, -5.5f}, {-0.4f, 1.6f, 8.0f}, 60.0f, "inside_away");
    add_view(scene, {0.9f, 1.7f, 7.0f}, {-0.2f, 1.9f, -8.0f}, 60.0f, "inside_towards");
    add_view(scene, {21.0f, 3.4f, 1.0f}, {0.0f, 2.2f, 0.0f}, 50.0f, "outside");
    return scene;
}

namespace {

Scene cloud_scene(const char* name) {
    Scene scene = empty_scene(name, 13.2f);
    add_ground(scene, 2'000.0f, kMoss);
    Mesh m{"markers", {}, mat4(1.0f)};
    box(m, kClay, {-2.6f, 0.0f, -2.6f}, {-2.3f, 2.2f, -2.3f}, kBottom);
    box(m, kClay, {2.3f, 0.0f, -2.6f}, {2.6f, 2.2f, -2.3f}, kBottom);
    scene.add_static(std::move(m));
    add_sun(scene, sky_direction(40.0f, 75.0f), 80'000.0f, {1.0f, 0.94f, 0.84f});
    add_view(scene, {1.4f, 3.0f, 5.2f}, {0.0f, 1.3f, 0.0f}, 45.0f);
    return scene;
}

}  // namespace

Scene cube() {
    Scene scene = cloud_scene("cube");
    scene.media.push_back(box_medium({3.96f, 0.04f, 0.2f}, {0.0f, 1.4f, 0.0f}, {2.0f, 2.0f, 2.0f}, 0.25f));
    return scene;
}

Scene ragged() {
    Scene scene = cloud_scene("ragged");
    auto cloud = ellipsoid_medium({3.0f, 0.03f, 0.4f}, {0.0f, 1.6f, 0.0f}, {2.1f, 1.3f, 1.6f}, 1.0f);
    cloud["noise"] = medium_noise(0.9f, 1.0f, 7);
    scene.media.push_back(cloud);
    return scene;
}

}  // namespace tyndall::bench_scenes
