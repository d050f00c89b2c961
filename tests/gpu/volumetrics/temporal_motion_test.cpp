// Where the setting temporal looks for what was, when the camera or what it sees moves.

#include <cmath>

#include "engine/core/image_metrics.h"
#include "tests/gpu/support/temporal_fixture.h"

namespace tyndall::test {
namespace {

// exp(-scale D), D = z' / z'' - 1 of a wall that was at z'' = 10 m; a wall that stays where it is and is approached
// is the same wall.
TEST_F(VolumetricsTemporal, AcceptanceFallsWithTheDistanceToWhatWasSeen) {
    for (const float scale : {0.0F, 1.0F, 4.0F})
        for (const float z : {8.0F, 10.0F, 15.0F}) {
            Settings s = settings(Temporal::acceptance);
            s.temporal_scale = scale;
            host.view_depth = [](int, int) { return 10.0F; };
            const double before = mean_of(after(2, s).scattering);
            host.view_depth = [z](int, int) { return z; };
            const Image now = draw(without(s)).scattering;
            host.view_depth = [](int, int) { return 10.0F; };
            after(2, s);
            host.view_depth = [z](int, int) { return z; };
            const Picture picture = draw(s);
            const double share = std::exp(-scale * (std::max(z, 10.0F) / std::min(z, 10.0F) - 1));
            EXPECT_NEAR(mean_of(picture.acceptance), share, 1e-3) << scale << ' ' << z;
            EXPECT_NEAR(mean_of(picture.scattering), mean_of(now) + 0.9 * share * (before - mean_of(now)),
                        2e-3 * before);
            draw(without(s));
        }
    Settings s = settings(Temporal::acceptance);
    s.temporal_scale = 100;
    host.view_depth = [](int, int) { return 5.0F; };
    EXPECT_EQ(accepted(s), 0) << "nothing was before";
    for (const float walk : {0.004F, 0.008F}) {
        host.eye = {0, 0, -walk};
        host.view_depth = [walk](int, int) { return 5 - walk; };
        EXPECT_GT(accepted(s), 0.999) << walk;
    }
}

// What the camera's travel leaves of a mean of 8 frames: nothing of one frame's 0.15 m before the sky, 0.075 m at
// 10 m and 14 mm at 1 m; 3 frames of a fourth of that.
TEST_F(VolumetricsTemporal, TravelForgetsByTheDistanceOfTheSurface) {
    const Settings s = settings(Temporal::accumulate);
    for (const glm::vec2 z_and_step : {glm::vec2(sky, 0.15F), {10, 0.075F}, {1, 0.15F / 11}})
        for (const float share : {1.02F, 0.25F}) {
            const float step = share * z_and_step.y, z = z_and_step.x;
            host.eye = {0, 0, 0};
            host.view_depth = [z](int, int) { return z; };
            after(8, s);
            host.eye = {0, 0, step};  // back from the wall
            host.view_depth = [z, step](int, int) { return z == sky ? sky : z + step; };
            EXPECT_NEAR(accepted(s), share > 1 ? 0 : 3.0 / 8, 0.01) << z << ' ' << step;
            draw(without(s));
        }
}

TEST_F(VolumetricsTemporal, SkyIsAcceptedWithSkyAndNothingElse) {
    const Settings s = settings(Temporal::accumulate);
    host.view_depth = [](int, int) { return sky; };
    draw(s);
    turn = 0.02F;
    EXPECT_GT(accepted(s), 0.95);  // without the border that came into view
    host.view_depth = [](int, int) { return 1000.0F; };
    EXPECT_EQ(accepted(s), 0);
    host.view_depth = [](int, int) { return sky; };
    EXPECT_EQ(accepted(s), 0);
}

// A floor, of which depth changes by a quarter from row to row far away, under a camera that walks and turns.
TEST_F(VolumetricsTemporal, FloorsAtGrazingAnglesAreAccepted) {
    host.size = {32, 64};
    host.vertical_fov = 0.6F;
    host.view_depth = [this](int x, int y) {
        const glm::vec3 ray = host.ray(x, y);
        return ray.y < -0.003F ? -1.6F / ray.y * -ray.z : sky;
    };
    Settings s = settings(Temporal::acceptance);
    s.temporal_scale = 16;
    draw(s);
    for (int i = 1; i <= 4; ++i) {
        host.eye = glm::vec3(0.002F, 0, -0.004F) * static_cast<float>(i);
        turn = 0.003F * static_cast<float>(i);
        const Image acceptance = draw(s).acceptance;
        double sum = 0;
        int count = 0;
        for (int y = 34; y < 60; ++y)  // row 0 is at the top; below: came into view
            for (int x = 3; x < 29; ++x, ++count) sum += acceptance.at(x, y)[0];
        EXPECT_GT(sum / count, 0.98) << i;
    }
}

// The light is put out after the first frame: what is left is that frame, nine tenths of it, where its pixels are
// now.
TEST_F(VolumetricsTemporal, HistoryFollowsTheCamera) {
    host.size = {40, 20};
    host.vertical_fov = 0.1F;
    host.view_depth = [](int, int) { return 40.0F; };
    host.ambient = {};
    add_sun_behind_fence();
    const auto error = [&](Temporal mode, int pixels) {
        const Settings s = settings(mode);
        host.sun_illuminance = glm::vec3(1000);
        turn = 0;
        const Image before = draw(s).scattering;
        host.sun_illuminance = glm::vec3(0);
        // What is seen goes to the left.
        turn =
            2 * std::tan(0.5F * host.vertical_fov) / static_cast<float>(host.size.y) * static_cast<float>(pixels);
        const Image now = draw(s).scattering;
        double sum = 0, light = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 8; x < host.size.x - 8; ++x) {
                sum += std::abs(now.at(x, y)[0] - 0.9 * before.at(x + pixels, y)[0]);
                light += 0.9 * before.at(x + pixels, y)[0];
            }
        draw(without(s));
        return sum / light;
    };
    for (const int pixels : {3, -5})
        for (const Temporal mode : {Temporal::ema, Temporal::acceptance})
            EXPECT_LT(error(mode, pixels), 0.01) << pixels;
    EXPECT_GT(error(Temporal::blend, 3), 0.1);
}

TEST_F(VolumetricsTemporal, HistoryFollowsWhatMoves) {
    host.size = {40, 20};
    host.ambient = {};
    add_sun_behind_fence();
    for (const Temporal mode : {Temporal::ema, Temporal::acceptance}) {
        const Settings s = settings(mode);
        set_motion({0, 0});
        host.sun_illuminance = glm::vec3(1000);
        const Image before = draw(s).scattering;
        host.sun_illuminance = glm::vec3(0);
        set_motion(glm::vec2(4, -2) / glm::vec2(host.size));
        const Image now = draw(s).scattering;
        for (int y = 2; y < 20; ++y)
            for (int x = 4; x < 40; ++x)  // 4 to the right and 2 down
                ASSERT_NEAR(now.at(x, y)[0], 0.9F * before.at(x - 4, y - 2)[0], 0.02 * mean_of(before))
                    << x << ' ' << y;
        for (int y = 0; y < 20; ++y) ASSERT_EQ(now.at(1, y)[0], 0);  // was off screen
        draw(without(s));
    }
}

// A pillar 0.5 m away, left of x = 0, before a wall 1 m away. The camera goes `walk` to the right: of the wall
// -walk <= x < 0 comes into view.
TEST_F(VolumetricsTemporal, WhatComesIntoViewIsOfTheNewFrameOnly) {
    host.size = {160, 8};
    constexpr float walk = 0.00025F;
    host.vertical_fov = 2 * walk;
    Settings s = settings(Temporal::acceptance, 0.05F);
    s.temporal_scale = 16;
    const auto tangent = [&](int x) { return host.ray(x, 4).x / -host.ray(x, 4).z; };
    host.view_depth = [&](int x, int) { return host.eye.x + 0.5F * tangent(x) < 0 ? 0.5F : 1.0F; };
    after(4, s);
    host.eye.x = walk;
    const Image now = draw(without(s)).scattering;
    host.eye.x = 0;
    after(4, s);
    host.eye.x = walk;
    const Picture picture = draw(s);
    const float margin = tangent(1) - tangent(0);
    int fresh = 0, known = 0;
    for (int x = 4; x < 150; ++x) {
        const float t = tangent(x);
        if (t > -2 * walk + margin && t < -walk - margin) {
            EXPECT_EQ(picture.acceptance.at(x, 4)[0], 0);
            EXPECT_NEAR(picture.scattering.at(x, 4)[0], now.at(x, 4)[0], 1e-3 * now.at(x, 4)[0]);
            ++fresh;
        } else if (t > -walk + margin || t < -2 * walk - margin) {
            EXPECT_GT(picture.acceptance.at(x, 4)[0], 0.99) << x;
            ++known;
        }
    }
    EXPECT_GE(fresh, 2);
    EXPECT_GE(known, 50);
}

// Ten steps, thin occluders, a light and a camera that move and come to rest.
TEST_F(VolumetricsTemporal, FewSamplesSettleAndNeverGetWorse) {
    host.size = {40, 22};
    host.ambient = {};
    host.view_depth = [this](int x, int y) {  // a pillar before a wall
        const glm::vec3 ray = host.ray(x, y);
        const float near = 12 + host.eye.z;
        return host.eye.x - ray.x / ray.z * near > 1.5F ? near : near + 13;
    };
    host.shadows = 1;
    Settings s = noisy(Temporal::accumulate);
    s.steps = 10;
    s.temporal_scale = 16;
    s.noise = volumetrics::Noise::bayer;
    s.noise_time = volumetrics::NoiseTime::golden_ratio;
    const auto place = [&](int i) {
        const auto t = static_cast<float>(i);
        set_shadowed_lamp({-2 + 0.05F * t, 6, -8}, 400, 40);
        host.eye = glm::vec3(0.03F, 0, -0.03F) * t;
    };
    constexpr int frames = 8;
    double single = 0;
    for (int i = 0; i < frames; ++i) {
        place(i);
        const Image expected = of_other(plain_settings(128));
        const double error_single = relative_rmse(of_other(without(s)), expected);  // of the same noise
        const double error = relative_rmse(draw(s).scattering, expected);
        EXPECT_LE(error, 1.1 * error_single) << i;
        single += error_single / frames;
    }
    const Image expected = of_other(plain_settings(128));
    const double error = relative_rmse(after(5, s).scattering, expected);
    EXPECT_LE(error, 0.25 * single);
}

}  // namespace
}  // namespace tyndall::test
