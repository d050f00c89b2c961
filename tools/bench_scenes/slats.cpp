// Light through a slatted wall, near and far.
#include "tools/bench_scenes/parts.h"

namespace tyndall::bench_scenes {

namespace {

// A hall 8 m wide, 12 m long and 5 m high, its west wall (x = -4) of upright boards between sill and lintel.
Mesh slatted_hall() {
    Mesh m{"hall", {}, mat4(1.0f)};
    box(m, kGround, {-4.3f, -0.3f, -12.3f}, {4.3f, 0.0f, 0.3f});
    box(m, kWood, {-4.3f, 5.0f, -12.3f}, {4.3f, 5.3f, 0.3f});
    box(m, kWood, {4.0f, 0.0f, -12.0f}, {4.3f, 5.0f, 0.0f});
    box(m, kWood, {-4.3f, 0.0f, -12.3f}, {4.3f, 5.0f, -12.0f});
    box(m, kWood, {-4.3f, 0.0f, 0.0f}, {4.3f, 5.0f, 0.3f});
    box(m, kStone, {-4.3f, 0.0f, -12.0f}, {-4.0f, 0.5f, 0.0f});
    box(m, kStone, {-4.3f, 4.5f, -12.0f}, {-4.0f, 5.0f, 0.0f});
    for (int i = 0; i < 14; ++i) {
        const float z = -11.8f + 0.85f * static_cast<float>(i);
        box(m, kDark, {-4.2f, 0.5f, z}, {-4.1f, 4.5f, z + 0.5f});
    }
    return m;
}

}  // namespace

Scene slats_sun() {
    Scene scene = empty_scene("slats_sun", 12.0f);
    scene.add_static(slatted_hall());
    Mesh blocks{"blocks", {}, mat4(1.0f)};
    box(blocks, kClay, {-0.6f, 0.0f, -7.0f}, {0.4f, 1.0f, -6.0f});
    box(blocks, kStone, {0.9f, 0.0f, -9.6f}, {1.6f, 2.4f, -8.9f});
    scene.add_static(std::move(blocks));
    add_sun(scene, sky_direction(25.0f, 56.0f), 60'000.0f);
    scene.media.push_back(box_medium({0.05f, 0.0f, 0.7f}, {0.0f, 2.5f, -6.0f}, {8.4f, 5.2f, 12.4f}, 0.0f));
    add_view(scene, {3.3f, 1.7f, -1.6f}, {-4.0f, 2.3f, -6.8f}, 62.0f);
    return scene;
}

Scene slats_spot() {
    Scene scene = empty_scene("slats_spot", 3.8f);
    add_ground(scene, 30.0f);
    Mesh m{"screen", {}, mat4(1.0f)};
    bars(m, kWood, {-3.9f, 0.0f, -9.0f}, {3.9f, 0.0f, -9.0f}, 0.2f, 0.45f, 4.0f);
    box(m, kWood, {-4.1f, 4.0f, -9.15f}, {4.1f, 4.2f, -8.85f});
    box(m, kWood, {-4.1f, 1.9f, -9.05f}, {4.1f, 2.05f, -8.95f});
    scene.add_static(std::move(m));
    add_spot(scene, {.position = {-0.8f, 2.6f, -13.0f}, .candela = 30'000.0f, .color = {1.0f, 0.86f, 0.62f}},
             {0.6f, 1.6f, -4.0f}, 32.0f, 42.0f);
    scene.media.push_back(global_medium({0.04f, 0.002f, 0.3f}));
    add_view(scene, {5.2f, 1.7f, -0.6f}, {-0.4f, 1.9f, -8.5f}, 55.0f);
    return scene;
}

Scene torture_slats() {
    Scene scene = empty_scene("torture_slats", 13.9f);
    add_ground(scene, 80.0f);
    Mesh m{"screen", {}, mat4(1.0f)};
    bars(m, kDark, {-6.0f, 0.0f, -30.0f}, {6.0f, 0.0f, -30.0f}, 0.05f, 0.1f, 6.0f);
    box(m, kDark, {-6.2f, 6.0f, -30.1f}, {6.2f, 6.2f, -29.9f});
    box(m, kDark, {-6.3f, 0.0f, -30.1f}, {-6.1f, 6.2f, -29.9f});
    box(m, kDark, {6.1f, 0.0f, -30.1f}, {6.3f, 6.2f, -29.9f});
    scene.add_static(std::move(m));
    add_sun(scene, sky_direction(14.0f, 14.0f), 30'000.0f, {1.0f, 0.74f, 0.48f});
    scene.media.push_back(global_medium({0.007f, 0.0f, 0.6f}));
    add_view(scene, {0.0f, 1.7f, 0.0f}, {0.0f, 2.9f, -30.0f}, 40.0f);
    return scene;
}

}  // namespace tyndall::bench_scenes
