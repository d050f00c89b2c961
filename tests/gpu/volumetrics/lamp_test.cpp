// In-scattered light of lamps against integration in double precision.

#include <cmath>
#include <random>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::test {
namespace {

class VolumetricsLamps : public GlTest {
  protected:
    StubHost host;

    /// Density of the first global medium at a height, and along a path.
    [[nodiscard]] double density(double y) const {
        const GlobalMedium& m = host.global[0];
        return m.height ? std::exp(-(y - m.base) / m.falloff) : 1;
    }
    [[nodiscard]] double path_density(glm::dvec3 from, glm::dvec3 to) const {
        const double rise = (to.y - from.y) / host.global[0].falloff;
        if (!host.global[0].height) return glm::distance(from, to);
        const double mean = std::abs(rise) < 1e-9 ? 1 : -std::expm1(-rise) / rise;
        return density(from.y) * mean * glm::distance(from, to);
    }

    /// Red in-scattered radiance of all lamps along a pixel's ray, by the laws of the design document.
    [[nodiscard]] double reference(glm::dvec3 direction, double view_depth) const {
        const GlobalMedium& m = host.global[0];
        const glm::dvec3 eye = host.eye;
        const double sigma_s = m.sigma_s.r, sigma_t = m.sigma_s.r + m.sigma_a.r;
        double sum = 0;
        for (const shared::GpuLight& light : host.lights) {
            const glm::dvec3 position(light.position_range), axis(light.direction_type);
            const double radius = light.intensity_radius.w, range = light.position_range.w;
            const auto integrand = [&](double t) {
                const glm::dvec3 point = eye + direction * t;
                const double d = glm::distance(point, position);
                if (d >= range) return 0.0;
                const glm::dvec3 travel = (point - position) / std::max(d, 1e-9);
                double value = (1 - std::pow(d / range, 4)) / std::max(d * d, radius * radius);
                if (light.direction_type.w == LIGHT_SPOT) {
                    const double s =
                        std::clamp(glm::dot(travel, axis) * light.cone_shadow.x + light.cone_shadow.y, 0.0, 1.0);
                    value *= s * s;
                }
                return value * light.intensity_radius.r * sigma_s * density(point.y) *
                       phase_hg(m.anisotropy, -glm::dot(travel, direction)) *
                       std::exp(-sigma_t * (path_density(eye, point) + path_density(position, point)));
            };
            // Split where the lamp is nearest; many panels, so that no short reach is stepped over.
            const double end = view_depth / -direction.z;
            const double nearest = std::clamp(glm::dot(position - eye, direction), 0.0, end);
            constexpr int panels = 1000;
            for (const auto& [a, b] : {std::pair{0.0, nearest}, std::pair{nearest, end}})
                for (int i = 0; i < panels; ++i)  // denser towards `nearest`
                {
                    const auto at = [&](double u) { return nearest + ((a < nearest ? a : b) - nearest) * u * u; };
                    sum += std::abs(gauss_legendre(integrand, at(double(i) / panels), at(double(i + 1) / panels)));
                }
        }
        return sum;
    }
};

double relative(double value, double expected) {
    return std::abs(value - expected) / std::abs(expected);
}

Settings lamp_settings(int steps, volumetrics::LampIntegration integration) {
    Settings settings = plain_settings(steps);
    settings.light.lamp_integration = integration;
    return settings;
}

TEST_F(VolumetricsLamps, SegmentsAgreeWithQuadratureAndBeatTheCentre) {
    host.view_depth = [](int, int) { return 40.0F; };
    host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.005F), .anisotropy = 0.4F}};
    double segment_error = 0, center_error = 0;
    for (const float distance : {0.1F, 0.3F, 1.0F, 3.0F, 10.0F, 20.0F}) {
        for (const float z : {-3.0F, -7.4F, -15.0F, -21.3F, -33.0F, -39.0F, -45.0F}) {
            host.lights = {point_light({distance, 0, z}, 10000)};
            const double expected = reference({0, 0, -1}, 40);
            const auto error = [&](volumetrics::LampIntegration integration) {
                return host.render(lamp_settings(8, integration)).scattering.at(0, 0)[0] / expected - 1;
            };
            const double segment = error(volumetrics::LampIntegration::segment);
            EXPECT_LE(std::abs(segment), 0.01) << distance << " m from the ray at " << z;
            segment_error += segment * segment;
            center_error += std::pow(error(volumetrics::LampIntegration::center), 2);
        }
    }
    EXPECT_LE(20 * std::sqrt(segment_error), std::sqrt(center_error));
}

TEST_F(VolumetricsLamps, CentreConvergesToTheSameLight) {
    host.view_depth = [](int, int) { return 40.0F; };
    host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.005F), .anisotropy = -0.3F}};
    host.lights = {point_light({0, 1, -11}, 10000, 15)};
    const double expected = reference({0, 0, -1}, 40);
    const Settings settings = lamp_settings(1024, volumetrics::LampIntegration::center);
    EXPECT_LE(relative(host.render(settings).scattering.at(0, 0)[0], expected), 2e-3);
}

TEST_F(VolumetricsLamps, DoublingALightDoublesItsScattering) {
    host.global = {{.sigma_s = glm::vec3(0.02F), .anisotropy = 0.2F}};
    for (const auto integration : {volumetrics::LampIntegration::center, volumetrics::LampIntegration::segment}) {
        float radiance[2];
        for (int i = 0; i < 2; ++i) {
            host.lights = {point_light({1, 1, -4}, i == 0 ? 300.0F : 600.0F)};
            radiance[i] = host.render(lamp_settings(8, integration)).scattering.at(0, 0)[0];
        }
        EXPECT_NEAR(radiance[1], 2 * radiance[0], radiance[1] / 1024);
    }
}

TEST_F(VolumetricsLamps, CrossingTheLampItselfIsFinite) {
    host.global = {{.sigma_s = glm::vec3(0.02F)}};
    host.lights = {point_light({0, 0, -4}, 1, 50, 0.05F)};
    const Settings settings = lamp_settings(8, volumetrics::LampIntegration::segment);
    EXPECT_LE(relative(host.render(settings).scattering.at(0, 0)[0], reference({0, 0, -1}, 10)), 0.01);
}

TEST_F(VolumetricsLamps, ALampBetweenSamplesIsNeverMissedNorCountedTwice) {
    host.view_depth = [](int, int) { return 40.0F; };
    host.global = {{.sigma_s = glm::vec3(0.01F), .anisotropy = 0.1F}};
    host.slices = 20;
    host.slice_depth = 1.7F;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform;
    for (int trial = 0; trial < 40; ++trial) {
        const float range = 0.2F + 3 * uniform(random);
        host.lights = {point_light({0.7F * range, 0, -1 - 37 * uniform(random)}, 10000, range)};
        // The shortest lists a host may make: exactly the slices in which the ray itself is within range.
        const double z = -host.lights[0].position_range.z;
        const double reach = range * std::sqrt(1 - 0.49);
        host.listed = [&](int, int slice) {
            const double begin = slice * host.slice_depth, end = slice == 19 ? 1e9 : begin + host.slice_depth;
            return begin <= z + reach && end >= z - reach;
        };
        const double expected = reference({0, 0, -1}, 40);
        for (int steps = 1; steps <= 8; ++steps) {
            const Settings settings = lamp_settings(steps, volumetrics::LampIntegration::segment);
            EXPECT_LE(relative(host.render(settings).scattering.at(0, 0)[0], expected), 0.01)
                << steps << " steps, lamp at " << z << " with range " << range;
        }
    }
}

TEST_F(VolumetricsLamps, SpotsAgreeWithQuadratureFromTheShortestLists) {
    host.view_depth = [](int, int) { return 40.0F; };
    host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.5F}};
    host.slices = 16;
    host.slice_depth = 2.5F;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(-1, 1);
    int lit = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const glm::vec3 position(3 * uniform(random), 3 * uniform(random), -20 + 18 * uniform(random));
        const glm::vec3 aim(0.5F * uniform(random), 0.5F * uniform(random), -20 + 18 * uniform(random));
        const float outer = std::cos(0.9F + 0.6F * uniform(random));
        host.lights = {spot_light(position, aim - position, 10000, outer + 0.6F * (1 - outer), outer, 25)};
        const shared::GpuLight& light = host.lights[0];
        host.listed = [&](int, int slice) {
            for (int i = 0; i <= 400; ++i) {
                const glm::vec3 point(0, 0, -host.slice_depth * (static_cast<float>(slice) + float(i) / 400));
                const glm::vec3 travel = point - position;
                const float d = glm::length(travel);
                if (d < 25 && glm::dot(travel, glm::vec3(light.direction_type)) >= d * outer) return true;
            }
            return false;
        };
        const double expected = reference({0, 0, -1}, 40);
        if (expected > 1e-4) ++lit;
        // Four nodes see little of where a cone's rim begins and ends: the error falls with the steps.
        for (const auto& [steps, tolerance] : {std::pair{4, 0.1}, std::pair{32, 0.03}, std::pair{256, 0.002}}) {
            const Settings settings = lamp_settings(steps, volumetrics::LampIntegration::segment);
            EXPECT_NEAR(host.render(settings).scattering.at(0, 0)[0], expected, tolerance * expected + 1e-5)
                << "trial " << trial << ", " << steps << " steps";
        }
    }
    EXPECT_GE(lit, 30);
}

TEST_F(VolumetricsLamps, LampsInHeightFogAgreeWithQuadrature) {
    host.size = {1, 5};
    host.vertical_fov = 1.2F;
    host.view_depth = [](int, int) { return 30.0F; };
    host.eye = {0, 6, 0};
    host.global = {{.sigma_s = glm::vec3(0.05F),
                    .sigma_a = glm::vec3(0.03F),
                    .anisotropy = 0.2F,
                    .height = true,
                    .base = 0,
                    .falloff = 3}};
    host.lights = {point_light({2, 1, -8}, 1000), point_light({-1, 9, -20}, 1000, 30),
                   point_light({1, 4, -2}, 1000)};
    for (const int steps : {2, 8}) {
        const Frame frame = host.render(lamp_settings(steps, volumetrics::LampIntegration::segment));
        for (int y = 0; y < 5; ++y) {
            const double expected = reference(host.ray(0, y), 30);
            EXPECT_LE(relative(frame.scattering.at(0, 4 - y)[0], expected), steps == 2 ? 0.03 : 0.01) << y;
        }
    }
}

TEST_F(VolumetricsLamps, VisibilityIsSampledWhereTheLightIs) {
    // A fence around the lamp shadows two fifths of the angles seen from it. The mean over all offsets must find
    // the shadowed light to a few percent with a single segment.
    host.size = {16, 16};
    host.vertical_fov = 1e-4F;
    host.view_depth = [](int, int) { return 20.0F; };
    host.global = {{.sigma_s = glm::vec3(0.01F)}};
    host.lights = {point_light({1, 0.3F, -9}, 1000)};
    host.shadows = 1;
    Settings settings = lamp_settings(1, volumetrics::LampIntegration::segment);
    settings.noise.kind = volumetrics::Noise::bayer;
    settings.noise.size = 16;
    const auto mean = [&](const Frame& frame) {
        double sum = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) sum += frame.scattering.at(x, y)[0];
        return sum / 256;
    };
    const double one = mean(host.render(settings));
    settings.march.steps = 512;
    EXPECT_LE(relative(one, mean(host.render(settings))), 0.03);
}

TEST_F(VolumetricsLamps, WithoutLightTransmittanceOnlyTheViewRayAttenuates) {
    host.global = {{.sigma_s = glm::vec3(0.2F), .sigma_a = glm::vec3(0.1F)}};
    host.lights = {point_light({3, 0, -5}, 1000)};
    Settings settings = lamp_settings(64, volumetrics::LampIntegration::segment);
    settings.light.transmittance = false;
    const double without = host.render(settings).scattering.at(0, 0)[0];
    const auto integrand = [](double t) {
        return 1000 * 0.2 / (4 * 3.14159265358979) / (9 + (t - 5) * (t - 5)) * std::exp(-0.3 * t);
    };
    EXPECT_LE(relative(without, integrate(integrand, 0, 10)), 2e-3);
    settings.light.transmittance = true;
    EXPECT_LE(relative(host.render(settings).scattering.at(0, 0)[0], reference({0, 0, -1}, 10)), 2e-3);
}

}  // namespace
}  // namespace tyndall::test
