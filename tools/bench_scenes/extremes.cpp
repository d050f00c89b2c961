// Lamps and media where estimators break: a lamp at the eye, one behind a thin wall, dense fog, sharp phase
// functions.
#include <array>

#include "tools/bench_scenes/parts.h"

namespace tyndall::bench_scenes {

Scene torture_lamp_at_eye() {
    Scene scene = empty_scene("torture_lamp_at_eye", 2.0f);
    add_ground(scene, 40.0f);
    Mesh m{"colonnade", {}, mat4(1.0f)};
    for (int i = 0; i < 7; ++i) {
        const float z = -3.0f - 2.5f * static_cast<float>(i);
        for (const float x : {-1.6f, 1.4f})
            box(m, kStone, {x - 0.15f, 0.0f, z - 0.15f}, {x + 0.15f, 3.0f, z + 0.15f}, kBottom);
        box(m, kWood, {-1.8f, 3.0f, z - 0.12f}, {1.6f, 3.2f, z + 0.12f});
    }
    scene.add_static(std::move(m));
    const vec3 eye(0.1f, 1.6f, 0.0f);
    // Forward scattering, so that the air next to the lamp does not outshine all else.
    add_point(scene, {.position = eye, .candela = 200.0f, .radius = 0.02f});
    scene.media.push_back(global_medium({0.009f, 0.0f, 0.85f}));
    add_view(scene, eye, {-0.1f, 1.5f, -10.0f}, 60.0f);
    return scene;
}

Scene torture_lamp_behind_wall() {
    Scene scene = empty_scene("torture_lamp_behind_wall", 2.5f);
    add_ground(scene, 30.0f);
    Mesh m{"wall", {}, mat4(1.0f)};
    // 2 cm thick, with an upright slit 3 cm wide.
    box(m, kPlaster, {-2.6f, 0.0f, -4.02f}, {0.9f, 2.8f, -4.0f}, kBottom);
    box(m, kPlaster, {0.93f, 0.0f, -4.02f}, {2.4f, 2.8f, -4.0f}, kBottom);
    box(m, kStone, {-1.7f, 0.0f, -3.2f}, {-1.2f, 0.9f, -2.7f}, kBottom);
    scene.add_static(std::move(m));
    add_point(scene, {.position = {0.2f, 1.4f, -4.3f}, .candela = 1'500.0f, .range = 25.0f});
    scene.media.push_back(global_medium({0.06f, 0.002f, 0.3f}));
    add_view(scene, {0.9f, 1.6f, 1.2f}, {0.0f, 1.5f, -4.0f}, 60.0f);
    return scene;
}

Scene torture_dense() {
    Scene scene = empty_scene("torture_dense", 3.0f);
    add_ground(scene, 20.0f);
    Mesh m{"blocks", {}, mat4(1.0f)};
    box(m, kStone, {-0.55f, 0.0f, -1.0f}, {-0.35f, 2.2f, -0.8f}, kBottom);
    box(m, kStone, {0.25f, 0.0f, -1.6f}, {0.5f, 1.5f, -1.35f}, kBottom);
    box(m, kPlaster, {-8.0f, 0.0f, -10.2f}, {8.0f, 6.0f, -10.0f}, kBottom);
    scene.add_static(std::move(m));
    // The far wall lies behind an optical depth of 20; lamps grow with what lies before them.
    add_point(scene, {.position = {-0.75f, 1.75f, -1.3f}, .candela = 60.0f, .range = 20.0f});
    add_point(scene,
              {.position = {0.7f, 1.35f, -2.2f}, .candela = 400.0f, .color = {0.4f, 0.6f, 1.0f}, .range = 20.0f});
    add_point(
        scene,
        {.position = {-0.2f, 2.4f, -4.0f}, .candela = 6'000.0f, .color = {1.0f, 0.35f, 0.2f}, .range = 20.0f});
    scene.media.push_back(global_medium({2.0f, 0.0f, 0.0f}));
    add_view(scene, {0.0f, 1.6f, 0.0f}, {0.0f, 1.6f, -10.0f}, 60.0f);
    return scene;
}

namespace {

// Two rows of columns in haze.
Scene avenue(const char* name, float exposure, float anisotropy) {
    Scene scene = empty_scene(name, exposure);
    add_ground(scene, 60.0f);
    Mesh m{"columns", {}, mat4(1.0f)};
    for (int i = 0; i < 6; ++i) {
        const float z = -5.0f - 4.0f * static_cast<float>(i);
        for (const float x : {-3.0f, 3.0f})
            box(m, kStone, {x - 0.35f, 0.0f, z - 0.35f}, {x + 0.35f, 6.0f, z + 0.35f}, kBottom);
    }
    scene.add_static(std::move(m));
    scene.media.push_back(global_medium({0.01f, 0.0f, anisotropy}));
    add_view(scene, {0.3f, 1.8f, 0.0f}, {0.0f, 3.0f, -14.0f}, 60.0f);
    return scene;
}

}  // namespace

Scene torture_forward() {
    Scene scene = avenue("torture_forward", 8.3f, 0.95f);
    add_sun(scene, sky_direction(16.0f, 11.0f), 1'000.0f);
    add_spot(scene, {.position = {2.0f, 2.2f, -20.0f}, .candela = 20'000.0f, .color = {0.5f, 0.7f, 1.0f}},
             {0.8f, 1.6f, 0.0f}, 12.0f, 20.0f);
    return scene;
}

Scene torture_backward() {
    Scene scene = avenue("torture_backward", 8.5f, -0.95f);
    add_sun(scene, sky_direction(10.0f, 165.0f), 1'000.0f);
    add_spot(scene, {.position = {1.2f, 1.4f, 0.5f}, .candela = 10'000.0f, .color = {0.5f, 0.7f, 1.0f}},
             {-1.0f, 3.0f, -18.0f}, 12.0f, 20.0f);
    return scene;
}

}  // namespace tyndall::bench_scenes
