#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaders/lib/glm_subset.h"
#include "tests/unit/shader_lib/quadrature.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/transmittance.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;

double relative_error(double value, double expected) {
    return std::abs(value / expected - 1.0);
}

TEST(Transmittance, HomogeneousIsBeerLambertPerChannel) {
    const glm::vec3 sigma_t{0.0f, 0.03f, 1.7f};
    const glm::vec3 t = glsl::transmittance_homogeneous(sigma_t, 2.5f);
    EXPECT_EQ(t.x, 1.0f);
    EXPECT_LT(relative_error(t.y, std::exp(-0.075)), 1e-6);
    EXPECT_LT(relative_error(t.z, std::exp(-1.7f * 2.5)), 1e-6);
}

TEST(Transmittance, SegmentIntegralIsExactFromVacuumToOpaque) {
    for (double length : {1e-3, 0.1, 1.0, 37.0, 1e4}) {
        for (double exponent = -12; exponent <= 3; exponent += 0.05) {
            const auto tau = static_cast<float>(std::pow(10.0, exponent));
            const auto d = static_cast<float>(length);
            const glsl::MediumSegment segment = glsl::integrate_segment(glm::vec3(tau, 0.0f, 0.5f * tau), d);
            const double x = tau;
            ASSERT_LT(relative_error(segment.effective_length.x, d * -std::expm1(-x) / x), 1e-6) << "tau " << tau;
            ASSERT_LT(relative_error(segment.effective_length.z, d * -std::expm1(-0.5 * x) / (0.5 * x)), 1e-6);
            ASSERT_LT(relative_error(glsl::mean_exponential(tau), -std::expm1(-x) / x), 1e-6) << "tau " << tau;
            ASSERT_EQ(segment.effective_length.y, d);
            ASSERT_EQ(segment.transmittance.y, 1.0f);
            if (x < 80) {
                ASSERT_LT(relative_error(segment.transmittance.x, std::exp(-x)), 1e-6 + 1e-7 * x);
            }
        }
    }
}

TEST(Transmittance, SegmentIntegralIsThatOfTheTransmittance) {
    for (float sigma : {1e-5f, 0.01f, 0.4f, 3.0f}) {
        const double expected = test::integrate([&](double t) { return std::exp(-sigma * t); }, 0.0, 12.0);
        EXPECT_LT(
            relative_error(glsl::integrate_segment(glm::vec3(sigma * 12.0f), 12.0f).effective_length.x, expected),
            1e-6);
    }
}

TEST(Transmittance, SegmentOfNoLengthAddsNothing) {
    const glsl::MediumSegment segment = glsl::integrate_segment(glm::vec3(0.0f), 0.0f);
    EXPECT_EQ(segment.transmittance, glm::vec3(1.0f));
    EXPECT_EQ(segment.effective_length, glm::vec3(0.0f));
}

// Energy: what a segment takes out of a beam is sigma_t times its effective length.
TEST(Transmittance, SegmentConservesEnergy) {
    for (float tau = 1e-3f; tau < 50.0f; tau *= 1.1f) {
        const float d = 3.0f;
        const glsl::MediumSegment segment = glsl::integrate_segment(glm::vec3(tau), d);
        EXPECT_NEAR(segment.transmittance.x + tau / d * segment.effective_length.x, 1.0f, 2e-6f);
    }
}

TEST(Transmittance, HeightDensityMatchesQuadrature) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 3000; ++i) {
        const auto falloff = static_cast<float>(0.5 * std::pow(100.0, unit(random)));
        const auto base = static_cast<float>(-5.0 + 10.0 * unit(random));
        const auto origin_y = static_cast<float>(-10.0 + 40.0 * unit(random));
        const auto length = static_cast<float>(0.01 * std::pow(1e5, unit(random)));
        // Level, nearly level, and steep rays.
        double dy = std::pow(10.0, -8.0 * unit(random)) * (unit(random) < 0.5 ? -1 : 1);
        if (i % 20 == 0) {
            dy = 0.0;
        }
        const auto direction_y = static_cast<float>(dy);
        const double steepest = std::max(-(origin_y - base), -(origin_y + direction_y * length - base)) / falloff;
        if (steepest > 0.9 * glsl::HEIGHT_MAX_EXPONENT) {
            continue;
        }
        const auto density = [&](double t) {
            return std::exp(-(double{origin_y} + double{direction_y} * t - base) / falloff);
        };
        const double expected = test::integrate(density, 0.0, length);
        const double value = glsl::height_density_length(origin_y, direction_y, length, base, falloff);
        // The exponent is rounded to single precision, which is that much relative error in its exponential.
        const double largest = (std::abs(origin_y - base) + std::abs(direction_y * length)) / falloff;
        ASSERT_LT(relative_error(value, expected), 2e-6 + 2e-7 * largest)
            << "y " << origin_y << " dy " << direction_y << " length " << length << " falloff " << falloff;
    }
}

TEST(Transmittance, LevelRayIsTheLimitOfSteeperOnes) {
    const float level = glsl::height_density_length(3.0f, 0.0f, 50.0f, 0.0f, 8.0f);
    EXPECT_NEAR(level, 50.0 * std::exp(-3.0 / 8.0), 1e-5);
    for (float dy : {1e-30f, 1e-12f, 1e-9f, -1e-9f, -1e-12f}) {
        EXPECT_NEAR(glsl::height_density_length(3.0f, dy, 50.0f, 0.0f, 8.0f), level, 1e-5f);
    }
}

TEST(Transmittance, PathsComposeAndReverse) {
    for (float dy : {-0.9f, -0.2f, -1e-4f, 0.0f, 1e-4f, 0.3f, 1.0f}) {
        const auto depth = [&](float t0, float t1) {
            return glsl::height_density_length(2.0f + dy * t0, dy, t1 - t0, 0.0f, 6.0f);
        };
        for (float split : {0.1f, 4.0f, 13.0f, 19.9f}) {
            const float whole = depth(0.0f, 20.0f);
            EXPECT_NEAR((depth(0.0f, split) + depth(split, 20.0f)) / whole, 1.0f, 4e-6f);
            const glm::vec3 sigma_t{0.02f, 0.05f, 0.11f};
            const glm::vec3 product = glsl::transmittance_homogeneous(sigma_t, split) *
                                      glsl::transmittance_homogeneous(sigma_t, 20.0f - split);
            EXPECT_NEAR(glm::length(product - glsl::transmittance_homogeneous(sigma_t, 20.0f)), 0.0f, 1e-6f);
        }
        EXPECT_NEAR(glsl::height_density_length(2.0f + dy * 20.0f, -dy, 20.0f, 0.0f, 6.0f) / depth(0.0f, 20.0f),
                    1.0f, 4e-6f);
    }
}

TEST(Transmittance, InfinitePathIsTheLimitOfLongOnes) {
    for (float sine : {0.05f, 0.3f, 1.0f}) {
        const double expected =
            test::integrate([&](double t) { return std::exp(-(2.0 + sine * t) / 8.0); }, 0.0, 60.0 * 8.0 / sine);
        EXPECT_LT(relative_error(glsl::height_density_length_to_infinity(2.0f, sine, 0.0f, 8.0f), expected), 2e-6);
    }
}

TEST(Transmittance, PathThatNeverLeavesTheMediumIsOpaque) {
    for (float sine : {0.0f, -0.3f, 1e-38f}) {
        const float length = glsl::height_density_length_to_infinity(2.0f, sine, 0.0f, 8.0f);
        EXPECT_EQ(std::exp(-1e-20f * length), 0.0f);
        EXPECT_EQ(glsl::transmittance_homogeneous(glm::vec3(0.0f), length), glm::vec3(1.0f));
    }
}

TEST(Transmittance, NothingOverflows) {
    for (float y : {-1e4f, -500.0f, 0.0f, 1e4f}) {
        for (float dy : {-1.0f, -1e-3f, 0.0f, 1.0f}) {
            for (float falloff : {0.01f, 1.0f, 1e4f}) {
                const float length = glsl::height_density_length(y, dy, 1e4f, 0.0f, falloff);
                EXPECT_TRUE(std::isfinite(length) && length >= 0.0f) << y << " " << dy << " " << falloff;
                const glsl::MediumSegment segment =
                    glsl::integrate_segment(glm::vec3(0.0f, 1e-3f, 10.0f) * length, 1e4f);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_TRUE(segment.transmittance[c] >= 0.0f && segment.transmittance[c] <= 1.0f);
                    EXPECT_TRUE(segment.effective_length[c] >= 0.0f && segment.effective_length[c] <= 1e4f);
                }
                EXPECT_EQ(segment.transmittance.x, 1.0f);
            }
        }
    }
}

// Light is in proportion to the optical depth only where that is not cut off (global_media.glsl: at 1e30).
TEST(Transmittance, TheDensestHeightMediumKeepsItsOpticalDepth) {
    for (float dy : {-1.0f, -3e-3f, 0.0f})
        EXPECT_LT(1e3f * glsl::height_density_length(-1e4f, dy, 1e9f, 0.0f, 1.0f), 1e30f) << dy;
}

}  // namespace
