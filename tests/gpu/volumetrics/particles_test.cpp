// The technique particles: what its discs add up to against closed forms, and where it may not fail.

#include <gmock/gmock.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/low_resolution.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using ::testing::ElementsAre;

class VolumetricsParticles : public GlTest {
  protected:
    VolumetricsParticles() {
        s.technique = "particles";
        s.particles.count = 4096;
        host.size = {48, 32};
        host.view_depth = [](int, int) { return 30.0F; };
    }

    StubHost host;
    Settings s = plain_settings(1);

    /// Mean over the picture of a channel of an image, and the standard deviation of its pixels.
    static glm::dvec2 mean_and_deviation(const Image& image, int channel = 0) {
        double sum = 0, squares = 0;
        const double count = image.size.x * image.size.y;
        for (int y = 0; y < image.size.y; ++y)
            for (int x = 0; x < image.size.x; ++x) {
                const double value = image.at(x, y)[channel];
                sum += value;
                squares += value * value;
            }
        return {sum / count, std::sqrt(std::max(squares / count - sum * sum / count / count, 0.0))};
    }
    void sunlight() {
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.3F, -1, 0.4F));
        host.sun_illuminance = glm::vec3(1000);
    }
    /// A box that fills the view, with its front at 10 m and its back at 20 m.
    void box_in_view(float sigma_s, float sigma_a) {
        host.vertical_fov = 0.4F;
        host.local = {{.shape = Shape::box,
                       .center = {0, 0, -15},
                       .half_extent = {10, 8, 5},
                       .sigma_s = glm::vec3(sigma_s),
                       .sigma_a = glm::vec3(sigma_a)}};
    }
};

TEST_F(VolumetricsParticles, TransmittanceOfGlobalMediaIsBeerLambert) {
    host.view_depth = [](int x, int) { return 0.2F + 3.0F * static_cast<float>(x); };
    host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = {0, 0.01F, 0.04F}},
                   {.sigma_a = glm::vec3(0.02F), .height = true, .falloff = 1e6F}};
    const Frame frame = host.render(s);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x)
            for (int c = 0; c < 3; ++c) {
                const double d = host.view_depth(x, 0) / -host.ray(x, 31 - y).z;
                ASSERT_NEAR(frame.transmittance.at(x, y)[c], std::exp(-(0.03 + host.global[0].sigma_a[c]) * d),
                            1e-3);
            }
}

TEST_F(VolumetricsParticles, SunIsTheClosedFormWithAnyNumberOfParticles) {
    sunlight();
    struct Particles {
        int count;
        float size;  // 0.25: most pixels have none
    };
    for (const glm::vec3 sigma_s : {glm::vec3(0.02F), glm::vec3(0.002F, 0.02F, 0.08F)})
        for (const Particles particles : {Particles{512, 1}, {8192, 1}, {512, 0.25F}})
            for (const float depth : {3.0F, 30.0F, 200.0F}) {
                host.global = {{.sigma_s = sigma_s, .sigma_a = glm::vec3(0.01F)}};
                s.particles.count = particles.count;
                s.particles.size = particles.size;
                host.view_depth = [depth](int, int) { return depth; };
                const Frame frame = host.render(s);
                for (int y = 0; y < 32; ++y)
                    for (int x = 0; x < 48; ++x)
                        for (int c = 0; c < 3; ++c) {
                            const double d = depth / -host.ray(x, 31 - y).z, sigma_t = sigma_s[c] + 0.01;
                            const double expected =
                                1000 * phase_hg(0, 0) * sigma_s[c] / sigma_t * -std::expm1(-sigma_t * d);
                            ASSERT_NEAR(frame.scattering.at(x, y)[c], expected, 3e-3 * expected)
                                << particles.count << " of size " << particles.size << ", " << depth
                                << " m, channel " << c;
                        }
            }
}

// Half of the air in shadow: nothing but the particles knows.
TEST_F(VolumetricsParticles, LampsAndShadowsAreThoseOfTheMarchOnAverage) {
    host.vertical_fov = 0.8F;
    host.view_depth = [](int, int) { return 12.0F; };
    host.global = {{.sigma_s = glm::vec3(0.05F), .anisotropy = 0.3F}};
    host.lights = {point_light({1, 3, -4}, 100), point_light({-3, -5, -5}, 100)};
    host.shadows = 2;
    sunlight();
    host.sun_illuminance = glm::vec3(5);
    Settings march = plain_settings(256);
    const Image exact = host.render(march).scattering;
    const glm::dvec2 expected = mean_and_deviation(exact);
    double last = 1;
    for (const auto& [count, tolerance] : {std::pair(4096, 0.15), std::pair(32768, 0.05)}) {
        s.particles.count = count;
        s.particles.distance = 24;
        const Image image = host.render(s).scattering;
        EXPECT_NEAR(mean_and_deviation(image).x, expected.x, tolerance * expected.x) << count;
        double error = 0;
        for (int i = 0; i < 48 * 32; ++i) error += std::pow(image.pixels[4 * i] - exact.pixels[4 * i], 2);
        error = std::sqrt(error / (48 * 32)) / expected.x;
        EXPECT_LT(error, last) << count;
        last = 0.75 * error;
    }
}

TEST_F(VolumetricsParticles, LocalMediaTakeAwayWhatBeerLambertSays) {
    s.particles.local_count = 8192;
    for (const float sigma_t : {0.02F, 0.1F, 0.3F}) {
        box_in_view(0, sigma_t);
        const Frame frame = host.render(s);
        double expected = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 48; ++x) expected += std::exp(-sigma_t * 10 / -host.ray(x, y).z) / (48 * 32);
        const glm::dvec2 found = mean_and_deviation(frame.transmittance);
        // The mean of exp(-x) is exp(-mean) (1 + variance / 2): 10% deviation of the optical depth at most.
        const double bias = expected * 0.5 * std::pow(0.1 * sigma_t * 10, 2);
        EXPECT_NEAR(found.x, expected + 0.5 * bias, 0.5 * bias + 0.01 * expected) << sigma_t;
        EXPECT_LT(found.y, expected * 0.15 * sigma_t * 10 + 0.03) << sigma_t;
    }
}

TEST_F(VolumetricsParticles, LocalMediaUnderEqualLightGainAndLoseNothing) {
    // What is scattered and what comes through are 1 together, wherever discs overlap. Their sum in half floats is
    // up to 3% too bright in a pixel and 0.9% in the mean.
    host.ambient = glm::vec3(1);
    s.particles.local_count = 8192;
    for (const auto& [sigma_s, worst, mean] :
         {std::tuple(0.02F, 0.008, 0.001), {0.3F, 0.02, 0.005}, {50.0F, 0.035, 0.012}}) {
        box_in_view(sigma_s, 0);
        host.global = {{.sigma_s = glm::vec3(0.01F)}};
        const Frame frame = host.render(s);
        double sum = 0;
        for (int i = 0; i < 48 * 32; ++i) {
            const double energy = frame.scattering.pixels[4 * i] + frame.transmittance.pixels[3 * i];
            ASSERT_NEAR(energy, 1, worst) << sigma_s;
            sum += energy / (48 * 32);
        }
        EXPECT_NEAR(sum, 1, mean) << sigma_s;
        EXPECT_LE(mean_and_deviation(frame.transmittance).x, std::exp(-sigma_s * 10));  // and the global medium
    }
}

TEST_F(VolumetricsParticles, LocalLightIsTheClosedFormOnAverage) {
    sunlight();
    s.light.transmittance = false;
    s.particles.local_count = 8192;
    box_in_view(0.05F, 0.05F);
    double expected = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x)
            expected += 1000 * phase_hg(0, 0) * 0.5 * -std::expm1(-0.1 * 10 / -host.ray(x, y).z) / (48 * 32);
    EXPECT_NEAR(mean_and_deviation(host.render(s).scattering).x, expected, 0.02 * expected);
    // A surface halfway through the box ends it there.
    host.view_depth = [](int, int) { return 15.0F; };
    EXPECT_NEAR(mean_and_deviation(host.render(s).transmittance).x, std::exp(-0.1 * 5 * 1.02), 0.02);
}

TEST_F(VolumetricsParticles, NothingBehindAWallIsSeen) {
    host.ambient = glm::vec3(1);
    host.local = {{.center = {0, 0, -20}, .half_extent = {6, 6, 6}, .sigma_s = glm::vec3(1)}};
    host.view_depth = [](int, int) { return 12.0F; };  // and the radius of a particle before it
    const Frame frame = host.render(s);
    for (int i = 0; i < 48 * 32; ++i) {
        ASSERT_EQ(frame.scattering.pixels[4 * i], 0);
        ASSERT_EQ(frame.transmittance.pixels[3 * i], 1);
    }
}

TEST_F(VolumetricsParticles, TheyStayWhereTheyAreWhenTheEyeMoves) {
    host.shadows = 1;
    sunlight();
    host.global = {{.sigma_s = glm::vec3(0.02F)}};
    host.vertical_fov = 0.01F;  // a far patch: a step of the eye hardly moves it
    host.view_depth = [](int, int) { return 40.0F; };
    const auto picture = [&](glm::vec3 eye) {
        host.eye = eye;
        return host.render(s).scattering.pixels[0];
    };
    // 16 m is a border between the cells of all levels: behind it each has another number.
    const float here = picture({0, 2, 15.999F});
    EXPECT_NEAR(picture({0, 2, 16.001F}), here, 2e-3F * here);
    EXPECT_GT(here, 0);
}

TEST_F(VolumetricsParticles, LowerResolutionIsTheSameWhereDiscsAreWide) {
    sunlight();
    box_in_view(0.02F, 0.02F);
    host.global = {{.sigma_s = {0.01F, 0.02F, 0.03F}}};
    s.particles.local_count = 256;  // 2 m wide, a fourth of the picture
    s.particles.count = 512;
    host.vertical_fov = 0.1F;
    for (const glm::ivec2 size : low_resolution_sizes) {
        host.size = size;
        s.resolution.size = volumetrics::Resolution::full;
        const Frame full = host.render(s);
        for (const auto resolution : {volumetrics::Resolution::half, volumetrics::Resolution::quarter}) {
            s.resolution.size = resolution;
            const Frame low = host.render(s);
            const double tolerance = resolution == volumetrics::Resolution::half ? 0.04 : 0.1;
            EXPECT_LT(largest_difference(low.scattering, full.scattering), tolerance) << size.x << " px";
            EXPECT_LT(largest_difference(low.transmittance, full.transmittance), tolerance) << size.x << " px";
        }
    }
}

TEST_F(VolumetricsParticles, MeanOverFramesIsOfMoreParticlesThanOneFrameHas) {
    sunlight();
    s.light.transmittance = false;
    s.particles.local_count = 512;
    box_in_view(0.02F, 0.02F);
    s.noise.kind = volumetrics::Noise::bayer;
    host.shadows = 1;
    s.particles.local_count = 262144;
    const Frame dense = host.render(s);
    s.particles.local_count = 512;
    const auto noise = [&](const Frame& frame) {
        Image difference = frame.scattering;
        for (std::size_t i = 0; i < difference.pixels.size(); ++i)
            difference.pixels[i] -= dense.scattering.pixels[i];
        return mean_and_deviation(difference).y;
    };
    const double one = noise(host.render(s));
    const auto last_of = [&](volumetrics::NoiseTime time) {
        const volumetrics::Temporal temporal = std::exchange(s.temporal.mode, volumetrics::Temporal::off);
        (void)host.render(s);  // forgets what was before
        s.temporal.mode = temporal;
        s.noise.time = time;
        Frame frame;
        for (host.frame_index = 0; host.frame_index < 12; ++host.frame_index) frame = host.render(s);
        return noise(frame);
    };
    s.temporal.mode = volumetrics::Temporal::accumulate;
    s.temporal.clip = s.temporal.reject = false;
    EXPECT_LT(last_of(volumetrics::NoiseTime::golden_ratio), 0.65 * one);
    EXPECT_NEAR(last_of(volumetrics::NoiseTime::fixed), one, 0.05 * one) << "they stay where they are";
    s.temporal.mode = volumetrics::Temporal::off;
    EXPECT_NEAR(last_of(volumetrics::NoiseTime::golden_ratio), one, 1e-3 * one) << "nothing would average them";
}

TEST_F(VolumetricsParticles, NoFilterBlursThem) {
    sunlight();
    box_in_view(0.2F, 0);
    const Frame plain = host.render(s);
    s.filter.kernel = volumetrics::Filter::gaussian15;
    const Frame frame = host.render(s);
    EXPECT_EQ(frame.scattering.pixels, plain.scattering.pixels);
    EXPECT_EQ(frame.skipped.at("volumetrics/filter_horizontal"), "pixels sample nothing");
}

TEST_F(VolumetricsParticles, LightIsLinearAndWithoutLightThereIsNone) {
    host.global = {{.sigma_s = glm::vec3(0.05F), .anisotropy = 0.4F}};
    host.local = {{.center = {0, 0, -6}, .half_extent = {2, 2, 2}, .sigma_s = glm::vec3(0.3F)}};
    const Frame dark = host.render(s);
    sunlight();
    host.shadows = 1;
    const Frame once = host.render(s);
    const Frame again = host.render(s);
    host.sun_illuminance *= 4.0F;
    const Frame four = host.render(s);
    for (int i = 0; i < 48 * 32; ++i) {
        const float value = once.scattering.pixels[4 * i];
        ASSERT_EQ(dark.scattering.pixels[4 * i], 0);
        ASSERT_EQ(again.scattering.pixels[4 * i], value);
        ASSERT_NEAR(four.scattering.pixels[4 * i], 4 * value, 2e-3 * value);
    }
}

TEST_F(VolumetricsParticles, FiniteAtTheExtremes) {
    host.size = {24, 16};
    host.view_depth = [](int x, int) { return x < 8 ? sky : x < 16 ? 0.11F : 5.0F; };
    sunlight();
    host.sun_illuminance = glm::vec3(1e8F);
    host.ambient = glm::vec3(1e8F);
    host.lights = {point_light({0, 0, 0}, 1e8F, 100, 0)};
    s.particles.count = s.particles.local_count = 512;
    for (const float sigma : {1e-6F, 1e4F})
        for (const float y : {0.0F, -1e6F}) {
            if (sigma == 1e4F) reconstruct_all(s);
            host.eye = {0, y, 0};
            host.global = {{.sigma_s = glm::vec3(sigma), .anisotropy = 0.999F},
                           {.sigma_s = glm::vec3(sigma, 0, sigma), .height = true, .falloff = 1}};
            host.local = {
                {.center = host.eye, .half_extent = {3, 3, 3}, .softness = 1, .sigma_s = glm::vec3(sigma)},
                {.center = host.eye - glm::vec3(0, 0, 2), .half_extent = {0, 1, 1}, .sigma_a = glm::vec3(sigma)}};
            const Frame frame = host.render(s);
            for (const float value : frame.scattering.pixels) ASSERT_TRUE(std::isfinite(value) && value >= 0);
            for (const float value : frame.transmittance.pixels) ASSERT_TRUE(value >= 0 && value <= 1);
        }
}

TEST_F(VolumetricsParticles, PassesWorkAndMemory) {
    host.count_work = true;
    sunlight();
    host.global = {{.sigma_s = glm::vec3(0.1F)}};
    const Frame frame = host.render(s);
    EXPECT_THAT(frame.live_passes, ElementsAre("volumetrics/particles_simulate", "volumetrics/particles",
                                               "volumetrics/particles_resolve"));
    // Each particle in view is lit once, whatever the size of the picture; out of view none is.
    const auto lookups = frame.work.at("volumetrics/particles_simulate")[int(gl::Work::shadow_lookups)];
    EXPECT_GT(lookups, 100U);
    EXPECT_LT(lookups, 4096U / 3);
    host.size = {96, 64};
    EXPECT_EQ(host.render(s).work.at("volumetrics/particles_simulate")[int(gl::Work::shadow_lookups)], lookups);
    EXPECT_GT(frame.persistent_bytes, 4000U * 48);
    s.technique = "ray_march";
    EXPECT_LT(host.render(s).persistent_bytes, 20000U);
    host.global.clear();
    EXPECT_EQ(host.render(s).persistent_bytes, 0U);
}

}  // namespace
}  // namespace tyndall::test
