// Many lamps at many distances, without and with shadows.
#include <array>

#include "tools/bench_scenes/parts.h"

namespace tyndall::bench_scenes {

namespace {

constexpr vec3 kWarm{1.0f, 0.70f, 0.38f}, kWhite{1.0f, 0.95f, 0.88f}, kBlue{0.35f, 0.55f, 1.0f},
    kRed{1.0f, 0.28f, 0.14f}, kGreen{0.35f, 1.0f, 0.55f};

struct Placed {
    vec3 position;
    float candela;
    vec3 color;
    bool spot;
    vec3 target;  // of a spot
};

void add_all(Scene& scene, std::span<const Placed> lamps, bool shadow, float range) {
    for (const Placed& p : lamps) {
        const Lamp lamp{p.position, p.candela, p.color, shadow, range, 0.03f};
        if (p.spot)
            add_spot(scene, lamp, p.target, 14.0f, 22.0f);
        else
            add_point(scene, lamp);
    }
}

}  // namespace

Scene lamps_open() {
    Scene scene = empty_scene("lamps_open", 2.2f);
    add_ground(scene, 60.0f);
    // Eye at (0, 1.8, 4): from 2.3 m to 44 m away; the third and fifth lie on rays through the middle of the
    // picture.
    const std::array<Placed, 12> lamps{{
        {{-1.3f, 1.1f, 2.2f}, 6.0f, kWarm, false, {}},
        {{2.2f, 2.9f, 0.0f}, 30.0f, kBlue, false, {}},
        {{0.0f, 1.75f, -3.0f}, 25.0f, kWhite, false, {}},
        {{-3.4f, 0.6f, -3.5f}, 40.0f, kRed, false, {}},
        {{0.6f, 1.5f, -12.0f}, 150.0f, kWarm, false, {}},
        {{7.5f, 3.5f, -12.0f}, 250.0f, kGreen, false, {}},
        {{-16.0f, 2.5f, -28.0f}, 1200.0f, kWarm, false, {}},
        {{9.0f, 2.0f, -40.0f}, 2500.0f, kWhite, false, {}},
        {{-4.5f, 5.5f, -5.5f}, 900.0f, kWhite, true, {-4.0f, 0.0f, -7.0f}},
        {{4.2f, 5.0f, -6.0f}, 900.0f, kWarm, true, {2.6f, 0.0f, -5.0f}},
        {{-9.0f, 6.5f, -16.0f}, 4000.0f, kBlue, true, {-5.0f, 0.0f, -17.0f}},
        {{3.0f, 2.6f, -20.0f}, 5000.0f, kWarm, true, {0.2f, 1.7f, 4.0f}},
    }};
    add_all(scene, lamps, false, 0.0f);
    scene.media.push_back(global_medium({0.02f, 0.001f, 0.2f}));
    add_view(scene, {0.0f, 1.8f, 4.0f}, {0.0f, 1.9f, -10.0f}, 55.0f);
    return scene;
}

Scene lamps_shadowed() {
    Scene scene = empty_scene("lamps_shadowed", 1.2f);
    add_ground(scene, 40.0f);
    Mesh post{"post", {}, mat4(1.0f)};
    box(post, kStone, {-0.14f, 0.0f, -0.14f}, {0.14f, 3.2f, 0.14f}, kBottom);
    const int mesh = scene.add_mesh(std::move(post));
    for (int row = 0; row < 9; ++row) {
        for (int column = 0; column < 8; ++column) {
            const float shift = row % 2 ? 1.0f : 0.0f;
            scene.add_instance(
                "post", mesh,
                {-7.5f + 2.0f * static_cast<float>(column) + shift, 0.0f, -1.0f - 2.2f * static_cast<float>(row)},
                static_cast<float>(17 * (row + 3 * column)));
        }
    }
    const std::array<Placed, 12> lamps{{
        {{-2.4f, 1.2f, -2.1f}, 40.0f, kWarm, false, {}},
        {{2.6f, 1.6f, -4.3f}, 60.0f, kWarm, false, {}},
        {{-0.6f, 2.2f, -6.6f}, 90.0f, kBlue, false, {}},
        {{-5.5f, 1.3f, -6.5f}, 90.0f, kRed, false, {}},
        {{5.4f, 1.1f, -8.8f}, 120.0f, kGreen, false, {}},
        {{1.5f, 1.4f, -11.0f}, 160.0f, kWarm, false, {}},
        {{-3.5f, 1.8f, -13.2f}, 220.0f, kWhite, false, {}},
        {{4.5f, 2.5f, -17.6f}, 350.0f, kWarm, false, {}},
        {{-6.0f, 5.0f, -3.0f}, 2500.0f, kWhite, true, {-2.5f, 0.0f, -5.0f}},
        {{6.0f, 5.0f, -5.0f}, 2500.0f, kBlue, true, {2.5f, 0.0f, -6.5f}},
        {{0.5f, 3.5f, -21.0f}, 6000.0f, kWarm, true, {0.5f, 1.0f, -10.0f}},
        {{-8.5f, 4.0f, -15.0f}, 4000.0f, kRed, true, {-3.0f, 1.0f, -11.0f}},
    }};
    add_all(scene, lamps, true, 14.0f);
    scene.media.push_back(global_medium({0.035f, 0.002f, 0.3f}));
    add_view(scene, {0.4f, 2.1f, 3.6f}, {0.0f, 1.4f, -8.0f}, 55.0f);
    return scene;
}

}  // namespace tyndall::bench_scenes
