// Where light of the sky comes through a window, from above, between leaves and not through a wall. The sun stays
// out of the room and the shed, and low in the court.
#include <array>

#include "tools/bench_scenes/parts.h"
#include "tools/modeling/random.h"

namespace tyndall::bench_scenes {

Scene sky_room() {
    Scene scene = empty_scene("sky_room", 5.5f);
    add_ground(scene, 60.0f);
    // 6 m wide (X), 3 m high, 8 m long, with a window of 1.6 m by 1.2 m in the wall at -X.
    Mesh m{"room", {}, mat4(1.0f)};
    box(m, kWood, {-3.2f, 0.0f, -8.2f}, {3.2f, 0.1f, 0.2f}, kBottom);
    box(m, kPlaster, {-3.2f, 3.1f, -8.2f}, {3.2f, 3.3f, 0.2f});
    box(m, kPlaster, {3.0f, 0.1f, -8.2f}, {3.2f, 3.1f, 0.2f});
    box(m, kPlaster, {-3.2f, 0.1f, -8.2f}, {3.0f, 3.1f, -8.0f});
    box(m, kPlaster, {-3.2f, 0.1f, 0.0f}, {3.0f, 3.1f, 0.2f});
    box(m, kPlaster, {-3.2f, 0.1f, -8.0f}, {-3.0f, 1.0f, 0.0f});
    box(m, kPlaster, {-3.2f, 2.2f, -8.0f}, {-3.0f, 3.1f, 0.0f});
    box(m, kPlaster, {-3.2f, 1.0f, -8.0f}, {-3.0f, 2.2f, -5.4f});
    box(m, kPlaster, {-3.2f, 1.0f, -3.8f}, {-3.0f, 2.2f, 0.0f});
    scene.add_static(std::move(m));
    Mesh table{"table", {}, mat4(1.0f)};
    box(table, kClay, {-0.8f, 0.1f, -5.4f}, {0.6f, 0.9f, -4.4f}, kBottom);
    scene.add_static(std::move(table));
    add_sun(scene, sky_direction(35.0f, -100.0f), 60'000.0f);
    scene.media.push_back(global_medium({0.03f, 0.0f, 0.4f}));
    add_view(scene, {2.4f, 1.7f, -0.6f}, {-2.2f, 1.4f, -6.4f}, 62.0f);
    return scene;
}

Scene sky_court() {
    Scene scene = empty_scene("sky_court", 9.5f);
    add_ground(scene, 80.0f);
    // 10 m square, walls of 9 m, a doorway of 2 m by 2.6 m in that at -Z and a roof over the side at +X.
    Mesh m{"court", {}, mat4(1.0f)};
    box(m, kStone, {-5.5f, 0.0f, -10.5f}, {-5.0f, 9.0f, 0.5f}, kBottom);
    box(m, kStone, {5.0f, 0.0f, -10.5f}, {5.5f, 9.0f, 0.5f}, kBottom);
    box(m, kStone, {-5.0f, 0.0f, 0.0f}, {5.0f, 9.0f, 0.5f}, kBottom);
    box(m, kPlaster, {-5.0f, 0.0f, -10.5f}, {-2.0f, 9.0f, -10.0f}, kBottom);
    box(m, kPlaster, {0.0f, 0.0f, -10.5f}, {5.0f, 9.0f, -10.0f}, kBottom);
    box(m, kPlaster, {-2.0f, 2.6f, -10.5f}, {0.0f, 9.0f, -10.0f});
    box(m, kWood, {2.4f, 3.0f, -10.0f}, {5.0f, 3.15f, 0.0f});
    for (int i = 0; i < 5; ++i) {
        const float z = -9.6f + 2.3f * static_cast<float>(i);
        box(m, kWood, {2.4f, 0.0f, z - 0.1f}, {2.6f, 3.0f, z + 0.1f}, kBottom);
    }
    box(m, kStone, {-1.6f, 0.0f, -5.6f}, {-0.4f, 0.8f, -4.4f}, kBottom);
    scene.add_static(std::move(m));
    add_sun(scene, sky_direction(20.0f, 100.0f), 40'000.0f, {1.0f, 0.86f, 0.68f});
    scene.media.push_back(global_medium({0.02f, 0.0f, 0.5f}));
    add_view(scene, {-3.8f, 1.7f, -0.6f}, {2.0f, 2.6f, -9.0f}, 65.0f);
    return scene;
}

Scene sky_forest() {
    Scene scene = empty_scene("sky_forest", 10.0f);
    add_ground(scene, 120.0f, kMoss);
    Mesh tree{"tree", {}, mat4(1.0f)};
    const std::array<vec2, 4> trunk{{{0.28f, 0.0f}, {0.2f, 1.0f}, {0.16f, 7.0f}, {0.03f, 12.0f}}};
    lathe(tree, kWood, vec3(0), trunk, 7);
    // Leaves: squares of 1.1 m, 5 to 12 m up, one side up and one down.
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        const float height = random.range(5.0f, 12.0f), out = 2.6f * (1.0f - 0.06f * (height - 5.0f));
        const float azimuth = random.range(0.0f, 2.0f * kPi), radius = out * (0.25f + 0.75f * random.unit());
        const vec3 center(radius * cosine(azimuth), height, radius * sine(azimuth));
        const vec3 half(0.55f, 0.02f, 0.55f);
        box(tree, kMoss, center - half, center + half, kLeft | kRight | kBack | kFront);
    }
    const int mesh = scene.add_mesh(std::move(tree));
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 9; ++column) {
            if (row == 7 && column == 4) continue;  // a clearing
            scene.add_instance("tree", mesh,
                               {3.4f * static_cast<float>(column - 4) + random.range(-0.9f, 0.9f), 0.0f,
                                6.0f - 3.4f * static_cast<float>(row) + random.range(-0.9f, 0.9f)},
                               random.range(0.0f, 360.0f), random.range(0.85f, 1.15f));
        }
    add_sun(scene, sky_direction(42.0f, 60.0f), 50'000.0f, {1.0f, 0.9f, 0.74f});
    scene.media.push_back(height_medium({0.02f, 0.0f, 0.5f}, 0.0f, 6.0f));
    add_view(scene, {0.6f, 1.6f, 4.2f}, {0.2f, 2.6f, -10.0f}, 62.0f);
    return scene;
}

Scene sky_thin_wall() {
    Scene scene = empty_scene("sky_thin_wall", 10.5f);
    add_ground(scene, 80.0f);
    // A shed 2.4 m wide and high and 16 m long, open before the camera, of boards 3 cm thick; the field on its
    // left.
    constexpr float kBoard = 0.03f;
    Mesh m{"shed", {}, mat4(1.0f)};
    box(m, kPlaster, {0.0f, 0.0f, -18.0f}, {kBoard, 2.4f, -2.0f}, kBottom);
    box(m, kPlaster, {2.4f, 0.0f, -18.0f}, {2.4f + kBoard, 2.4f, -2.0f}, kBottom);
    box(m, kPlaster, {0.0f, 2.4f, -18.0f}, {2.4f + kBoard, 2.4f + kBoard, -2.0f});
    box(m, kPlaster, {kBoard, 0.0f, -18.0f}, {2.4f, 2.4f, -18.0f + kBoard}, kBottom);
    box(m, kClay, {0.9f, 0.0f, -9.0f}, {1.6f, 0.9f, -8.3f}, kBottom);
    box(m, kClay, {-1.9f, 0.0f, -9.0f}, {-1.2f, 0.9f, -8.3f}, kBottom);
    scene.add_static(std::move(m));
    add_sun(scene, sky_direction(30.0f, 100.0f), 40'000.0f, {1.0f, 0.9f, 0.75f});
    scene.media.push_back(global_medium({0.03f, 0.0f, 0.3f}));
    add_view(scene, {0.5f, 1.6f, 0.6f}, {0.3f, 1.3f, -10.0f}, 60.0f);
    return scene;
}

}  // namespace tyndall::bench_scenes
