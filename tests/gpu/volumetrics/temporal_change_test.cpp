// What the setting temporal must forget, and what it must not.

#include "engine/core/image_metrics.h"
#include "tests/gpu/support/temporal_fixture.h"

namespace tyndall::test {
namespace {

TEST_F(VolumetricsTemporal, NothingStaleAfterAChange) {
    Settings first = settings(Temporal::accumulate);
    std::vector<Settings> changes(4, first);
    changes[0].temporal = Temporal::ema;
    changes[1].temporal_place = TemporalPlace::before;
    changes[2].technique = "particles";
    changes[3].resolution = volumetrics::Resolution::half;
    for (const Settings& change : changes) {
        after(2, first);
        EXPECT_EQ(accepted(first), 1);
        EXPECT_EQ(accepted(change), 0);
        EXPECT_EQ(accepted(change), 1);
    }
    after(2, first);
    host.size = {9, 5};
    EXPECT_EQ(accepted(first), 0);
    host.size = {1, 1};
    EXPECT_EQ(accepted(first), 0);
    EXPECT_EQ(accepted(first), 1);
}

// Of light that goes out, which is seen, and of a lamp that goes away, which is told, less than 5% is left after 4
// frames.
TEST_F(VolumetricsTemporal, ChangedLightIsForgotten) {
    host.size = {32, 18};
    host.ambient = glm::vec3(0.05F);
    host.shadows = 1;
    for (const Temporal mode : {Temporal::ema, Temporal::accumulate})
        for (const bool clip : {false, true}) {
            Settings s = noisy(mode);
            s.temporal_clip = clip;
            const auto expect_forgotten = [&](glm::vec3 from, glm::vec3 to, float intensity) {
                set_shadowed_lamp(from, 100);
                const Image on = after(32, s).scattering;
                set_shadowed_lamp(to, intensity);
                const Image off = of_other(plain_settings(256));
                EXPECT_LT(residual_light(after(4, s).scattering, on, off), 0.05) << int(mode) << clip;
            };
            expect_forgotten({-1, 5, -5}, {-1, 5, -5}, 0);
            expect_forgotten({-1, 1, -5}, {500, 1, -5}, 100);  // from where it is in view
        }
}

TEST_F(VolumetricsTemporal, MediumThatChangesIsForgotten) {
    for (const Temporal mode : {Temporal::ema, Temporal::accumulate}) {
        after(8, settings(mode));
        host.global[0].sigma_s *= 1.3F;
        EXPECT_EQ(accepted(settings(mode)), 0);
        after(8, settings(mode));
        host.global[0].sigma_s *= 1.001F;
        EXPECT_GT(accepted(settings(mode)), 0.9);
    }
}

TEST_F(VolumetricsTemporal, NoiseIsNoChange) {
    host.size = {32, 18};
    add_sun_behind_fence();
    for (const auto filter : {volumetrics::Filter::none, volumetrics::Filter::gaussian15})
        for (const bool lamp : {false, true}) {
            host.lights.clear();
            if (lamp) set_shadowed_lamp({-1, 0.5F, -5}, 400);
            Settings s = noisy(Temporal::accumulate);
            s.filter = filter;
            after(16, s);
            double mean = 0;
            for (int i = 0; i < 16; ++i) mean += accepted(s) / 16;
            EXPECT_GT(mean, 0.97) << lamp << int(filter);
            draw(without(s));
        }
}

}  // namespace
}  // namespace tyndall::test
