// The technique analytic_fog: its curves against their definitions, a mixture of media against quadrature, energy,
// and what it leaves out. What it shares with other techniques is in march_test.cpp.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using volumetrics::FogMode;

constexpr std::array all_modes{FogMode::linear, FogMode::squared, FogMode::exponential, FogMode::height};

class AnalyticFog : public GlTest {
  protected:
    [[nodiscard]] static Settings settings(FogMode mode = FogMode::height) {
        Settings settings = plain_settings(1);
        settings.technique = "analytic_fog";
        settings.analytic_fog.mode = mode;
        return settings;
    }
    StubHost host;
};

double relative(double value, double expected) {
    return std::abs(value - expected) / std::abs(expected);
}

/// As GL_LINEAR, GL_EXP2 and GL_EXP define them, with one half at ln 2 mean free paths.
double transmittance(FogMode mode, double mean_free_paths) {
    const double halves = mean_free_paths / std::numbers::ln2;
    switch (mode) {
        case FogMode::linear:
            return std::max((2 - halves) / 2, 0.0);
        case FogMode::squared:
            return std::pow(0.5, halves * halves);
        default:
            return std::pow(0.5, halves);
    }
}

TEST_F(AnalyticFog, CurvesAreThoseOfTheirDefinitions) {
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.3F, -0.5F, 0.6F));
    host.sun_illuminance = {1000, 2000, 4000};
    host.ambient = {3, 2, 1};
    const glm::vec3 sigma_s(0.02F, 0.04F, 0.06F), sigma_a(0.02F, 0.01F, 0.04F), emission(1, 4, 2);
    host.global = {{.sigma_s = sigma_s, .sigma_a = sigma_a, .anisotropy = 0.5F, .emission = emission}};
    host.size = {9, 1};
    host.vertical_fov = 1e-4F;
    host.view_depth = [](int x, int) { return x == 8 ? sky : 0.5F * std::pow(2.0F, static_cast<float>(x)); };
    for (const FogMode mode : all_modes) {
        const Frame frame = host.render(settings(mode));
        for (int x = 0; x < 9; ++x)
            for (int c = 0; c < 3; ++c) {
                const double sigma_t = sigma_s[c] + sigma_a[c];
                const double t = x == 8 ? 0 : transmittance(mode, sigma_t * 0.5 * std::exp2(x));
                const double p = phase_hg(0.5, host.sun_direction.z);
                const double source = sigma_s[c] * (p * host.sun_illuminance[c] + host.ambient[c]) + emission[c];
                EXPECT_NEAR(frame.transmittance.at(x, 0)[c], t, 1e-3 * t + 3e-8) << int(mode) << ' ' << x;
                EXPECT_LE(relative(frame.scattering.at(x, 0)[c], source / sigma_t * (1 - t)), 1e-3)
                    << int(mode) << ' ' << x;
            }
    }
}

TEST_F(AnalyticFog, AllModesButHeightTakeTheMediaAtTheEye) {
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.3F, -0.5F, 0.6F));
    host.sun_illuminance = glm::vec3(1000);
    host.eye = {0, 7, 0};
    host.global = {
        {.sigma_s = glm::vec3(0.05F), .sigma_a = glm::vec3(0.03F), .height = true, .base = 2, .falloff = 4}};
    const double density = std::exp(-5.0 / 4), sun_depth = 0.08 * density * 4 / -host.sun_direction.y;
    for (const FogMode mode : {FogMode::linear, FogMode::squared, FogMode::exponential}) {
        const Frame frame = host.render(settings(mode));
        const double t = transmittance(mode, 0.08 * density * 10);
        EXPECT_LE(relative(frame.transmittance.at(0, 0)[0], t), 1e-3);
        EXPECT_LE(relative(frame.scattering.at(0, 0)[0],
                           1000 / (4 * std::numbers::pi) * 5 / 8 * std::exp(-sun_depth) * (1 - t)),
                  1e-3);
    }
}

/// A further sun, of the light list.
shared::GpuLight further_sun(glm::vec3 direction, glm::vec3 illuminance) {
    return {.position_range = glm::vec4(-SUN_LAMP_DISTANCE * direction, 0),
            .intensity_radius = glm::vec4(illuminance * SUN_LAMP_DISTANCE * SUN_LAMP_DISTANCE, 0),
            .direction_type = {direction, LIGHT_SUN},
            .cone_shadow = {0, 1, -1, 0}};
}

TEST_F(AnalyticFog, FurtherSunsAddTheLightOfASunOfTheirDirection) {
    host.size = {2, 5};
    host.vertical_fov = 1.6F;
    host.eye = {0, 7, 0};
    host.view_depth = [](int x, int) { return x == 0 ? 20.0F : sky; };
    host.global = {{.sigma_s = {0.01F, 0.02F, 0.03F}, .sigma_a = glm::vec3(0.01F), .anisotropy = 0.4F},
                   {.sigma_s = glm::vec3(0.05F), .height = true, .base = 2, .falloff = 4}};
    const glm::vec3 directions[] = {glm::normalize(glm::vec3(0.3F, -0.5F, 0.6F)),
                                    glm::normalize(glm::vec3(-1, -0.2F, 0.1F)),
                                    glm::normalize(glm::vec3(0.1F, -1, -0.7F))};
    const glm::vec3 lux[] = {{1000, 2000, 500}, {700, 100, 300}, {10, 900, 400}};
    host.has_sun = true;
    for (const char* name : {"analytic_fog", "radial_shafts"})
        for (const FogMode mode : all_modes) {
            Settings s = settings(mode);
            Image expected({2, 5}, 4);
            for (int i = 0; i < 3; ++i) {
                host.lights.clear();
                host.sun_direction = directions[i];
                host.sun_illuminance = lux[i];
                const Image one = host.render(s).scattering;
                for (std::size_t k = 0; k < one.pixels.size(); ++k) expected.pixels[k] += one.pixels[k];
            }
            host.sun_direction = directions[0];
            host.sun_illuminance = lux[0];
            host.lights = {further_sun(directions[1], lux[1]), further_sun(directions[2], lux[2])};
            s.technique = name;
            if (s.technique == "radial_shafts") {
                if (mode != FogMode::height) continue;
                host.view_depth = [](int, int) { return sky; };  // nothing shadows the first
                s.radial_shafts.unseen = 1;
            }
            const Image all = host.render(s).scattering;
            for (int x = s.technique == "radial_shafts" ? 1 : 0; x < 2; ++x)
                for (int y = 0; y < 5; ++y)
                    for (int c = 0; c < 3; ++c)
                        EXPECT_LE(relative(all.at(x, y)[c], expected.at(x, y)[c]), 2e-3)
                            << name << ' ' << int(mode) << ' ' << x << ' ' << y;
        }
}

/// A homogeneous medium and some height media of one phase function under some suns.
struct Mixture {
    struct Height {
        double sigma, base, falloff;
    };
    double homogeneous;
    std::vector<Height> heights;
    double eye_y;
    std::vector<double> to_suns_y;

    /// At a height: all media, and the optical depth of those above.
    [[nodiscard]] glm::dvec2 at(double y) const {
        glm::dvec2 sum(homogeneous, 0);
        for (const Height& h : heights)
            sum += h.sigma * std::exp((h.base - y) / h.falloff) * glm::dvec2(1, h.falloff);
        return sum;
    }
    /// Radiance for suns of 4 pi lux, by quadrature.
    [[nodiscard]] double radiance(double dy, double length) const {
        double thinnest = 1e9, sum = 0, depth = 0;
        for (const Height& h : heights) thinnest = std::min(thinnest, h.falloff / std::max(std::abs(dy), 1e-6));
        for (double a = 0, b = 0; a < length && depth < 30; a = b) {
            const glm::dvec2 here = at(eye_y + dy * a);
            b = std::min(a + std::min({thinnest, 0.2 / here.x, 0.1 + 0.3 * a}), length);
            const auto depth_to = [&](double t) {
                return gauss_legendre([&](double u) { return at(eye_y + dy * u).x; }, a, t);
            };
            sum += gauss_legendre(
                [&](double t) {
                    const glm::dvec2 there = at(eye_y + dy * t);
                    double arriving = 0;
                    for (const double y : to_suns_y) arriving += std::exp(-there.y / y);
                    return there.x * arriving * std::exp(-depth - depth_to(t));
                },
                a, b);
            depth += depth_to(b);
        }
        return sum;
    }
};

// Mixtures drawn at random. The target rounds to 5e-4.
TEST_F(AnalyticFog, MixtureOfMediaAgreesWithQuadrature) {
    std::mt19937 random(1);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
    const auto logarithmic = [&](double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); };
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(4 * std::numbers::pi);
    host.size = {3, 7};
    host.vertical_fov = 1.6F;
    const float far[] = {10, 100, 3000};
    host.view_depth = [&](int x, int) { return far[x]; };
    for (const int heights : {1, 3}) {
        std::vector<double> errors;
        for (int i = 0; i < 60; ++i) {
            host.sun_direction = glm::normalize(glm::vec3(0.4F, -uniform(0.05, 1), 0.2F));
            const glm::vec3 second = glm::normalize(glm::vec3(-0.1F, -uniform(0.05, 1), -0.4F));
            host.lights = {further_sun(second, host.sun_illuminance)};
            Mixture m{.homogeneous = logarithmic(1e-4, 0.05),
                      .heights = {},
                      .eye_y = uniform(0, 100),
                      .to_suns_y = {-host.sun_direction.y, -second.y}};
            for (int k = 0; k < heights; ++k)
                m.heights.push_back({logarithmic(1e-3, 1), k == 0 ? 0 : uniform(-20, 20), logarithmic(1, 100)});
            host.eye = {0, m.eye_y, 0};
            host.global = {{.sigma_s = glm::vec3(m.homogeneous)}};
            for (const Mixture::Height& h : m.heights)
                host.global.push_back({.sigma_s = glm::vec3(h.sigma),
                                       .height = true,
                                       .base = float(h.base),
                                       .falloff = float(h.falloff)});
            const Frame frame = host.render(settings());
            for (int x = 0; x < 3; ++x)
                for (int y = 0; y < 7; ++y) {
                    const glm::dvec3 d = host.ray(x, y);
                    const double expected = m.radiance(d.y, double(far[x]) / -d.z);
                    if (expected < 1e-3) continue;  // of a sun of 4 pi lux
                    errors.push_back(relative(frame.scattering.at(x, 6 - y)[0], expected));
                }
        }
        std::ranges::sort(errors);
        const auto at = [&](double share) { return errors[std::size_t(share * double(errors.size() - 1))]; };
        std::cout << heights << " height media, " << errors.size() << " rays: half within " << at(0.5) << ", 95% "
                  << at(0.95) << ", 99% " << at(0.99) << ", all " << at(1) << '\n';
        EXPECT_LE(at(0.95), 0.001);
        EXPECT_LE(at(0.99), 0.01);
        EXPECT_LE(at(1), 0.04);
    }
}

// Green ends forty times nearer than blue.
TEST_F(AnalyticFog, EachChannelOfAColouredMixtureIsAsInItsGreyOne) {
    host.size = {3, 7};
    host.vertical_fov = 1;
    host.view_depth = [](int x, int) { return x == 0 ? 20.0F : 1e9F; };
    const glm::vec3 coloured(0.03F, 0.17F, 0.004F), shines(0.3F, 0.5F, 1);
    const auto render = [&](const glm::vec3& sigma_a, const glm::vec3& emission) {
        host.global = {{.sigma_a = glm::vec3(0.003F), .emission = emission},
                       {.sigma_a = sigma_a, .height = true, .base = 2, .falloff = 19}};
        return host.render(settings()).scattering;
    };
    const Image all = render(coloured, shines);
    for (int c = 0; c < 3; ++c) {
        const Image grey = render(glm::vec3(coloured[c]), glm::vec3(shines[c]));
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 3; ++x)
                EXPECT_LT(relative(all.at(x, y)[c], grey.at(x, y)[c]), 0.01)
                    << "channel " << c << " of " << x << ", " << y;
    }
}

TEST_F(AnalyticFog, WhiteFurnaceKeepsItsEnergy) {
    // A medium that absorbs nothing, in light that comes from everywhere alike: what is lost is scattered in.
    host.ambient = glm::vec3(8);
    host.size = {3, 5};
    host.vertical_fov = 1.6F;
    host.view_depth = [](int x, int) { return x == 0 ? sky : x == 1 ? 5.0F : 400.0F; };
    for (const FogMode mode : all_modes)
        for (const bool mixture : {false, true}) {
            host.global = {{.sigma_s = {0.05F, 0.01F, 0.2F}}};
            if (mixture) host.global.push_back({.sigma_s = glm::vec3(0.1F), .height = true, .falloff = 2});
            const Frame frame = host.render(settings(mode));
            for (int i = 0; i < 15; ++i)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(frame.scattering.at(i % 3, i / 3)[c] + 8 * frame.transmittance.at(i % 3, i / 3)[c],
                                8, 0.016)
                        << int(mode) << ' ' << i;
        }
}

TEST_F(AnalyticFog, IsLinearInLight) {
    host.has_sun = true;
    host.global = {{.sigma_s = glm::vec3(0.05F), .anisotropy = 0.7F},
                   {.sigma_s = glm::vec3(0.05F), .height = true, .falloff = 3}};
    for (const FogMode mode : all_modes) {
        const auto light = [&](float sun, float ambient) {
            host.sun_illuminance = glm::vec3(sun);
            host.ambient = glm::vec3(ambient);
            return double(host.render(settings(mode)).scattering.at(0, 0)[0]);
        };
        EXPECT_LE(relative(light(100, 0) + light(0, 3), light(100, 3)), 2e-3);
        EXPECT_LE(relative(7 * light(100, 3), light(700, 21)), 2e-3);
        host.has_sun = false;
        const double without = light(100, 3);
        host.has_sun = true;
        EXPECT_EQ(without, light(0, 3));
    }
}

TEST_F(AnalyticFog, IsOnePassThatReadsOneDepthAPixel) {
    host.count_work = true;
    host.size = {8, 8};
    host.has_sun = true;
    host.global = {{.sigma_s = glm::vec3(0.1F)}, {.sigma_s = glm::vec3(0.1F), .height = true}};
    host.lights = {point_light({0, 0, -3}, 10)};
    const Frame frame = host.render(settings(FogMode::exponential));
    EXPECT_THAT(frame.live_passes, ElementsAre("volumetrics/analytic_fog"));
    const gl::WorkCounts& work = frame.work.at("volumetrics/analytic_fog");
    EXPECT_EQ(work[int(gl::Work::texture_fetches)], 64U);
    EXPECT_EQ(work[int(gl::Work::medium_samples)], 64U);
    EXPECT_EQ(work[int(gl::Work::shadow_lookups)], 0U);
    EXPECT_EQ(work[int(gl::Work::light_evaluations)], 0U);
}

TEST_F(AnalyticFog, LocalMediaAreLeftOut) {
    const GlobalMedium fog{.sigma_s = glm::vec3(0.1F)};
    const LocalMedium ball{.center = {0, 0, -5}, .sigma_s = {1, 2, 3}};
    host.ambient = glm::vec3(1);
    host.global = {fog};
    const Image alone = host.render(settings()).scattering;
    host.local = {ball};
    const Frame frame = host.render(settings());
    EXPECT_EQ(frame.scattering.pixels, alone.pixels);
    EXPECT_EQ(frame.skipped.at("volumetrics/inject_media"), "technique is analytic_fog");
    host.global.clear();
    EXPECT_THAT(host.render(settings()).live_passes, IsEmpty());
}

TEST_F(AnalyticFog, ExtremesStayFiniteAndBounded) {
    host.size = {3, 7};
    host.vertical_fov = 2.9F;
    host.has_sun = true;
    host.ambient = glm::vec3(1);
    host.sun_illuminance = glm::vec3(4);
    host.view_depth = [](int x, int y) { return x == 0 ? sky : std::pow(10.0F, static_cast<float>(y - 3)); };
    for (const float znear : {0.001F, 10.0F})
        for (const glm::vec3 sun : {glm::vec3(1, 0, 0), {0, -1e-7F, 1}, {0, -1, 0}, {0, 1, 0}})
            for (const float sigma : {1e-30F, 1e-8F, 1.0F, 1e4F})
                for (const float base : {-1e6F, 0.0F, 1e6F})
                    for (const float falloff : {0.01F, 1000.0F}) {
                        host.znear = znear;
                        host.sun_direction = glm::normalize(sun);
                        const glm::vec3 sigma_s{sigma, 0, sigma}, sigma_a{0, sigma, 0};
                        host.global = {{.sigma_s = sigma_s, .sigma_a = sigma_a},
                                       {.sigma_s = sigma_s, .height = true, .base = base, .falloff = falloff}};
                        for (const FogMode mode : all_modes) {
                            const Frame frame = host.render(settings(mode));
                            // Sun of 4 lx scattered isotropically is less than 1/pi; ambient light of 1.
                            for (int i = 0; i < 21; ++i)
                                for (int c = 0; c < 3; ++c) {
                                    const float v = frame.scattering.at(i % 3, i / 3)[c];
                                    const float t = frame.transmittance.at(i % 3, i / 3)[c];
                                    ASSERT_TRUE(v >= 0 && v <= 1.33F) << v << ' ' << sigma << ' ' << base;
                                    ASSERT_TRUE(t >= 0 && t <= 1) << t;
                                }
                        }
                    }
}

}  // namespace
}  // namespace tyndall::test
