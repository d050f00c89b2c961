// Air beside particles, per channel, and the phase functions of particles: against closed forms and quadrature in
// double precision, for every technique that has a phase function.

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::test {
namespace {

using volumetrics::PhaseFunction;
constexpr double pi = std::numbers::pi;

double phase_rayleigh(double c) {
    return 3 / (16 * pi) * (1 + c * c);
}
double phase_cornette_shanks(double g, double c) {
    return 3 / (8 * pi) * (1 - g * g) * (1 + c * c) / ((2 + g * g) * std::pow(1 + g * g - 2 * g * c, 1.5));
}
/// Of droplets 20 um wide.
double phase_droplets(double c) {
    const double g = std::exp(-2.20679 / 23.91029 - 0.428934), alpha = std::exp(3.62489 - 8.29288 / 25.52825);
    const double second = std::exp(-0.599085 / 19.358417 - 0.665888);
    return (1 - second) * phase_hg(std::exp(-0.0990567 / 18.32846), c) +
           second * phase_hg(g, c) * (1 + alpha * c * c) / (1 + alpha * (1 + 2 * g * g) / 3);
}

/// Scattering of air at sea level, 1/m.
const glm::vec3 clear_air(5.8e-6F, 13.5e-6F, 33.1e-6F);

class VolumetricsAir : public GlTest, public testing::WithParamInterface<std::string> {
  protected:
    [[nodiscard]] static Settings exact_settings(int steps = 8) {
        Settings settings = plain_settings(steps);
        settings.technique = GetParam();
        settings.froxels.x = 9;  // odd: the middle of the picture lies on a column
        settings.froxels.y = 45;
        return settings;
    }
    void expect_close(glm::dvec3 value, glm::dvec3 expected, double tolerance, const std::string& what) const {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(value[c] / expected[c], 1, tolerance) << what << ", channel " << c << ": " << value[c];
    }
    [[nodiscard]] glm::dvec3 radiance(const Settings& settings, int y = 0) {
        const Frame frame = host.render(settings);
        const float* pixel = frame.scattering.at(0, y);
        return {pixel[0], pixel[1], pixel[2]};
    }
    StubHost host;
};
INSTANTIATE_TEST_SUITE_P(Techniques, VolumetricsAir, testing::Values("ray_march", "froxel", "reference"),
                         [](const auto& info) { return info.param; });

// L = E (sigma_m p_m + sigma_a p_a) (1 - exp(-sigma_t d)) / sigma_t in each channel: blue air, grey haze.
TEST_P(VolumetricsAir, SunInAirAndHaze) {
    host.has_sun = true;
    host.sun_illuminance = {10000, 20000, 40000};
    const glm::vec3 air = 300.0F * clear_air;
    for (const float haze : {0.0F, 0.002F, 0.05F}) {
        for (const glm::vec3 direction :
             {glm::vec3(0, 0, 1), glm::vec3(0.3F, -0.5F, 0.6F), glm::vec3(1, -0.1F, 0)}) {
            host.sun_direction = glm::normalize(direction);
            host.global = {{.sigma_s = air, .rayleigh = true}};
            if (haze > 0) host.global.push_back({.sigma_s = glm::vec3(haze), .anisotropy = 0.6F});
            const double c = host.sun_direction.z;
            const glm::dvec3 sigma_t = glm::dvec3(air) + double(haze);
            const glm::dvec3 scattered = glm::dvec3(air) * phase_rayleigh(c) + haze * phase_hg(0.6F, c);
            const glm::dvec3 expected =
                glm::dvec3(host.sun_illuminance) * scattered * (1.0 - glm::exp(-10.0 * sigma_t)) / sigma_t;
            expect_close(radiance(exact_settings()), expected, 1e-3, fmt::format("haze {} cos {}", haze, c));
        }
    }
}

// What is ambient is scattered alike whatever the phase.
TEST_P(VolumetricsAir, AmbientLightSeesAllScattering) {
    host.ambient = {1, 2, 3};
    host.global = {{.sigma_s = glm::vec3(0.03F), .rayleigh = true},
                   {.sigma_s = glm::vec3(0.02F), .anisotropy = 0.8F}};
    expect_close(radiance(exact_settings()), glm::dvec3(host.ambient) * -std::expm1(-0.5), 1e-3, "ambient");
}

// Clear air as it is: 50 km of it, thinning by e in 8 km, under a high and a low sun; red to blue within one
// picture.
TEST_P(VolumetricsAir, ClearAirOverFiftyKilometres) {
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(1e5F);
    host.size = {1, 5};
    host.vertical_fov = 1.0F;
    host.eye = {0, 100, 0};
    host.view_depth = [](int, int) { return 5e4F; };
    host.global = {{.sigma_s = clear_air, .rayleigh = true, .height = true, .falloff = 8000}};
    Settings settings = exact_settings();
    settings.froxels.far = 4096;
    settings.march.max_distance = 1e5F;
    glm::dvec3 level[2];
    for (const double elevation : {0.9, 0.1}) {
        host.sun_direction = {0, -std::sin(elevation), std::cos(elevation)};
        const Frame frame = host.render(settings);
        for (int y = 0; y < 5; ++y) {
            const glm::dvec3 d = host.ray(0, y);
            const glm::dvec3 sigma(clear_air);
            const auto density = [](double h) { return std::exp(-h / 8000); };
            const auto channel = [&](int c) {
                return 1e5 * phase_rayleigh(-glm::dot(glm::dvec3(host.sun_direction), d)) *
                       integrate(
                           [&](double t) {
                               const double h = 100 + d.y * t, k = d.y / 8000;
                               const double mean = std::abs(k * t) < 1e-9 ? 1 : -std::expm1(-k * t) / (k * t);
                               const double depth =
                                   density(100) * mean * t + density(h) * 8000 / std::sin(elevation);
                               return sigma[c] * density(h) * std::exp(-sigma[c] * depth);
                           },
                           0, 5e4 / -d.z);
            };
            const glm::dvec3 expected(channel(0), channel(1), channel(2));
            const double tolerance = GetParam() == "froxel" ? 0.007 : 1e-3;
            if (y >= 2)  // below lies air of 30 km under the ground
                expect_close(glm::make_vec3(frame.scattering.at(0, 4 - y)), expected, tolerance,
                             fmt::format("{} at {}", y, elevation));
            if (y == 2) level[elevation < 0.5] = expected;
        }
    }
    EXPECT_GT(level[0].b, 2 * level[0].r);  // the colours that the numbers stand for
    EXPECT_GT(level[1].r, level[1].b);
}

TEST_P(VolumetricsAir, LampInAirAndHaze) {
    host.lights = {point_light({1.5F, 0.5F, -4}, 100)};
    const glm::dvec3 air(0.004F, 0.01F, 0.03F);
    const double haze = 0.02F;
    host.global = {{.sigma_s = glm::vec3(air), .rayleigh = true}, {.sigma_s = glm::vec3(haze), .anisotropy = 0.5F}};
    const glm::dvec3 position(host.lights[0].position_range), d(0, 0, -1);
    const auto channel = [&](int c) {
        return integrate(
            [&](double t) {
                const glm::dvec3 to_lamp = position - t * d;
                const double r = glm::length(to_lamp), cosine = glm::dot(to_lamp, d) / r;
                return 100 / (r * r) * std::exp(-(air[c] + haze) * (t + r)) *
                       (air[c] * phase_rayleigh(cosine) + haze * phase_hg(0.5, cosine));
            },
            0, 10);
    };
    const glm::dvec3 expected(channel(0), channel(1), channel(2));
    expect_close(radiance(exact_settings(16)), expected, 4e-3, "segment");
    Settings settings = exact_settings(400);
    settings.light.lamp_integration = volumetrics::LampIntegration::center;
    settings.froxels.z = 256;
    if (GetParam() != "reference") expect_close(radiance(settings), expected, 0.01, "center");
}

// A local medium's anisotropy is averaged with that of the haze, and not with the air.
TEST_P(VolumetricsAir, LocalMediumInAirAndHaze) {
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(1, -1, -1));
    host.sun_illuminance = glm::vec3(1000);
    const glm::dvec3 air(0.01F, 0.02F, 0.06F);
    host.global = {{.sigma_s = glm::vec3(air), .rayleigh = true, .height = true, .falloff = 1e9F},
                   {.sigma_s = glm::vec3(0.01F), .anisotropy = 0.6F}};
    host.local = {
        {.shape = Shape::box, .half_extent = glm::vec3(50), .sigma_s = glm::vec3(0.03125F), .anisotropy = -0.4F}};
    Settings settings = exact_settings();
    settings.light.transmittance = false;
    const double c = host.sun_direction.z, particles = 0.01 + 0.03125, g = (0.01 * 0.6 - 0.03125 * 0.4) / particles;
    const glm::dvec3 sigma = air + particles;
    const glm::dvec3 expected =
        1000.0 * (air * phase_rayleigh(c) + particles * phase_hg(g, c)) * (1.0 - glm::exp(-10.0 * sigma)) / sigma;
    expect_close(radiance(settings), expected, 2e-3, "local");
}

TEST_P(VolumetricsAir, PhaseFunctionsOfParticles) {
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(1e6F);
    for (const float g : {-0.4F, 0.0F, 0.7F, 0.95F}) {
        host.global = {{.sigma_s = glm::vec3(1e-6F), .anisotropy = g}};
        for (const glm::vec3 direction : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 1), glm::vec3(0.1F, 0.2F, -1)}) {
            host.sun_direction = glm::normalize(direction);
            const double c = host.sun_direction.z;
            Settings settings = exact_settings(1);
            settings.light.phase = PhaseFunction::cornette_shanks;
            expect_close(radiance(settings), glm::dvec3(10 * phase_cornette_shanks(g, c)), 1e-3, "Cornette-Shanks");
            settings.light.phase = PhaseFunction::double_henyey_greenstein;
            settings.light.back_anisotropy = -0.3F;
            settings.light.back_weight = 0.25F;
            expect_close(radiance(settings), glm::dvec3(7.5 * phase_hg(g, c) + 2.5 * phase_hg(-0.3, c)), 1e-3,
                         "two lobes");
            settings.light.phase = PhaseFunction::hg_draine;
            settings.light.droplet_diameter = 20;
            expect_close(radiance(settings), glm::dvec3(10 * phase_droplets(c)), 1e-3, "droplets");
        }
    }
}

}  // namespace
}  // namespace tyndall::test
