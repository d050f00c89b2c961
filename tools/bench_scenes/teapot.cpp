// A point light that circles behind a pot with a thin handle and spout.
#include <array>

#include "tools/bench_scenes/parts.h"
#include "tools/modeling/random.h"

namespace tyndall::bench_scenes {

namespace {

// Stands on the origin, 1 m high; handle towards -X, spout towards +X.
Mesh pot() {
    Mesh m{"pot", {}, mat4(1.0f)};
    const std::array<vec2, 13> body{{{0.0f, 0.0f},
                                     {0.30f, 0.0f},
                                     {0.33f, 0.04f},
                                     {0.46f, 0.14f},
                                     {0.55f, 0.28f},
                                     {0.57f, 0.40f},
                                     {0.53f, 0.52f},
                                     {0.43f, 0.64f},
                                     {0.36f, 0.70f},
                                     {0.37f, 0.73f},
                                     {0.28f, 0.80f},
                                     {0.12f, 0.86f},
                                     {0.04f, 0.88f}}};
    lathe(m, kClay, vec3(0), body, 40);
    const std::array<vec2, 6> knob{
        {{0.04f, 0.87f}, {0.04f, 0.90f}, {0.08f, 0.94f}, {0.075f, 0.97f}, {0.04f, 1.0f}, {0.0f, 1.005f}}};
    lathe(m, kClay, vec3(0), knob, 20);
    std::vector<vec3> path;
    std::vector<float> radii;
    for (int i = 0; i <= 24; ++i) {  // an arc of a torus
        const float a = (65.0f + 230.0f * static_cast<float>(i) / 24.0f) * kPi / 180.0f;
        path.push_back({-0.62f + 0.26f * cosine(a), 0.42f + 0.24f * sine(a), 0.0f});
        radii.push_back(0.022f);
    }
    tube(m, kClay, path, radii, 10);
    const std::array<vec3, 7> spout{{{0.44f, 0.24f, 0},
                                     {0.60f, 0.28f, 0},
                                     {0.70f, 0.38f, 0},
                                     {0.76f, 0.50f, 0},
                                     {0.83f, 0.62f, 0},
                                     {0.92f, 0.70f, 0},
                                     {0.98f, 0.72f, 0}}};
    const std::array<float, 7> widths{0.13f, 0.11f, 0.085f, 0.065f, 0.052f, 0.045f, 0.04f};
    tube(m, kClay, spout, widths, 14);
    return m;
}

}  // namespace

Scene teapot() {
    Scene scene = empty_scene("teapot", 2.0f);
    add_ground(scene, 20.0f);
    Mesh plinth{"plinth", {}, mat4(1.0f)};
    box(plinth, kStone, {-0.9f, 0.0f, -0.6f}, {0.9f, 0.7f, 0.6f}, kBottom);
    scene.add_static(std::move(plinth));
    const int mesh = scene.add_mesh(pot());
    scene.add_instance("pot", mesh, {0.0f, 0.7f, 0.0f});
    const int lamp = add_point(scene, {.position = {0.0f, 1.2f, -1.3f}, .candela = 160.0f, .range = 15.0f});
    // Once round in 4 s, in a plane behind the pot.
    Animation orbit{"orbit", {{lamp, false, {}, {}}}, {}};
    constexpr int kKeys = 40;
    for (int i = 0; i <= kKeys; ++i) {
        const float a = 2.0f * kPi * static_cast<float>(i % kKeys) / kKeys;
        orbit.channels[0].times.push_back(4.0f * static_cast<float>(i) / kKeys);
        orbit.channels[0].values.emplace_back(0.85f * sine(a), 1.2f + 0.4f * cosine(a), -1.3f, 0.0f);
    }
    scene.animations.push_back(orbit);
    scene.media.push_back(global_medium({0.12f, 0.005f, 0.3f}));
    add_view(scene, {0.5f, 1.35f, 3.4f}, {0.0f, 1.15f, 0.0f}, 45.0f);
    return scene;
}

}  // namespace tyndall::bench_scenes
