// Techniques against closed forms and independent integration in double precision.

#include <cmath>
#include <numbers>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/unit/shader_lib/quadrature.h"
#include "volumetrics/technique.h"

namespace tyndall::test {
namespace {

constexpr double pi = std::numbers::pi;

class VolumetricsMarch : public GlTest {
  protected:
    StubHost host;
};

std::vector<std::string> every_technique_but(const std::string& absent) {
    std::vector<std::string> names = volumetrics::technique_names();
    std::erase_if(names, [&](const std::string& name) { return name == "off" || name == absent; });
    return names;
}
std::vector<std::string> every_technique() {
    return every_technique_but("off");
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
    return info.param;
}

/// What every technique must get right whatever its number of samples.
class VolumetricsClosedForm : public VolumetricsMarch, public testing::WithParamInterface<std::string> {
  protected:
    [[nodiscard]] static Settings plain_settings(int steps) {
        Settings settings = test::plain_settings(steps);
        settings.technique = GetParam();
        settings.froxels_x = 64;
        settings.particle_count = settings.particle_local_count = 4096;
        return settings;
    }
    /// Relative error. Sheets add up in half floats: 0.5%.
    [[nodiscard]] static double tolerance() { return GetParam() == "billboards" ? 5e-3 : 1e-3; }
};
INSTANTIATE_TEST_SUITE_P(Techniques, VolumetricsClosedForm, testing::ValuesIn(every_technique()), name_of);

/// The same of the sun's light where it comes from all along the ray. Not of particles, which sample it: with
/// anisotropy, or where fog takes more of one colour than of another, a pixel of theirs is up to 77% off.
class VolumetricsSunClosedForm : public VolumetricsClosedForm {};
INSTANTIATE_TEST_SUITE_P(Techniques, VolumetricsSunClosedForm, testing::ValuesIn(every_technique_but("particles")),
                         name_of);

double relative(double value, double expected) {
    return std::abs(value - expected) / std::abs(expected);
}

TEST_P(VolumetricsClosedForm, HomogeneousSlabFollowsBeerLambert) {
    for (const glm::vec3 optical_depth :
         {glm::vec3(0.01F, 0.02F, 0.03F), glm::vec3(0.5F, 1, 2), glm::vec3(4, 6, 10)}) {
        host.global = {{.sigma_s = optical_depth / 20.0F, .sigma_a = optical_depth / 20.0F}};
        for (int steps : {1, 8, 33}) {
            const Frame frame = host.render(plain_settings(steps));
            for (int c = 0; c < 3; ++c)
                EXPECT_LE(relative(frame.transmittance.at(0, 0)[c], std::exp(-double(optical_depth[c]))), 1e-3)
                    << optical_depth[c] << " in " << steps << " steps";
            for (int c = 0; c < 3; ++c) EXPECT_EQ(frame.scattering.at(0, 0)[c], 0);
        }
    }
}

TEST_P(VolumetricsClosedForm, GreyMediumNeedsOneTarget) {
    host.global = {{.sigma_s = glm::vec3(0.5F), .sigma_a = glm::vec3(0.5F)}};
    const Frame frame = host.render(plain_settings(8));
    EXPECT_LE(relative(frame.scattering.at(0, 0)[3], std::exp(-10.0)), 1e-3);
}

TEST_P(VolumetricsClosedForm, TransmittanceNeverRisesWithDistance) {
    host.size = {64, 1};
    host.vertical_fov = 0.001F;
    host.view_depth = [](int x, int) { return x == 63 ? sky : 0.2F * std::pow(1.2F, static_cast<float>(x)); };
    for (const bool height : {false, true}) {
        host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.02F), .height = height, .falloff = 4}};
        const Frame frame = host.render(plain_settings(7));
        for (int x = 1; x < 64; ++x)
            EXPECT_LE(frame.transmittance.at(x, 0)[0], frame.transmittance.at(x - 1, 0)[0]) << x;
        EXPECT_EQ(frame.transmittance.at(63, 0)[0], 0);
    }
}

TEST_P(VolumetricsClosedForm, EmissionIsAttenuatedOnTheWayOut) {
    for (const float sigma : {1e-8F, 0.01F, 1.0F}) {
        const glm::vec3 emission(0.5F, 2, 8);
        host.global = {{.sigma_a = glm::vec3(sigma, 2 * sigma, 3 * sigma), .emission = emission}};
        const Frame frame = host.render(plain_settings(5));
        for (int c = 0; c < 3; ++c) {
            const double sigma_t = sigma * double(c + 1);
            const double expected = -emission[c] * std::expm1(-sigma_t * 10) / sigma_t;
            EXPECT_LE(relative(frame.scattering.at(0, 0)[c], expected), 1e-3) << sigma_t;
        }
    }
}

TEST_P(VolumetricsSunClosedForm, SunWithoutOccludersFollowsTheClosedForm) {
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.3F, -0.5F, 0.6F));
    host.sun_illuminance = {10000, 20000, 40000};
    // Light that leaves towards the eye travels along +Z.
    const double cos_theta = host.sun_direction.z;
    for (const float g : {-0.9F, 0.0F, 0.5F, 0.9F}) {
        for (const float sigma : {1e-6F, 0.01F, 0.3F}) {
            host.global = {
                {.sigma_s = glm::vec3(sigma), .sigma_a = glm::vec3(0, sigma, 2 * sigma), .anisotropy = g}};
            for (const auto dither : {volumetrics::Noise::none, volumetrics::Noise::bayer}) {
                Settings settings = plain_settings(8);
                settings.noise = dither;
                const Frame frame = host.render(settings);
                for (int c = 0; c < 3; ++c) {
                    const double sigma_t = sigma * double(c + 1);
                    const double expected = host.sun_illuminance[c] * sigma * phase_hg(g, cos_theta) *
                                            -std::expm1(-sigma_t * 10) / sigma_t;
                    EXPECT_LE(relative(frame.scattering.at(0, 0)[c], expected), 1e-3) << g << ' ' << sigma_t;
                }
            }
        }
    }
}

TEST_P(VolumetricsClosedForm, VanishingExtinctionKeepsTheScattering) {
    host.has_sun = true;  // above, and not behind the wall that radial_shafts would see before it
    host.sun_illuminance = glm::vec3(1e7F);
    host.global = {{.sigma_s = glm::vec3(1e-8F)}};
    const Frame frame = host.render(plain_settings(8));
    EXPECT_LE(relative(frame.scattering.at(0, 0)[0], 1e7 * 1e-8 * 10 / (4 * pi)), 1e-3);
    EXPECT_NEAR(frame.transmittance.at(0, 0)[0], 1, 2e-7);
}

TEST_P(VolumetricsClosedForm, AmbientIsScatteredIsotropically) {
    host.ambient = {1, 2, 3};
    host.global = {{.sigma_s = glm::vec3(0.1F), .sigma_a = glm::vec3(0.1F), .anisotropy = 0.8F}};
    const Frame frame = host.render(plain_settings(3));
    for (int c = 0; c < 3; ++c)
        EXPECT_LE(relative(frame.scattering.at(0, 0)[c], host.ambient[c] * 0.5 * -std::expm1(-2.0)), 1e-3);
}

TEST_P(VolumetricsSunClosedForm, SchlickApproximatesHenyeyGreenstein) {
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(1, 0, 1));
    host.global = {{.sigma_s = glm::vec3(1e-6F), .anisotropy = 0.4F}};
    host.sun_illuminance = glm::vec3(1e6F);
    Settings settings = plain_settings(1);
    settings.phase = volumetrics::PhaseFunction::schlick;
    const double k = 1.55 * 0.4 - 0.55 * 0.064;
    const double expected = (1 - k * k) / (4 * pi * std::pow(1 - k * std::numbers::sqrt2 / 2, 2)) * 10;
    EXPECT_LE(relative(host.render(settings).scattering.at(0, 0)[0], expected), 1e-3);
}

// Fog with a height profile seen from above, level and from below, with and without a homogeneous medium.
struct HeightCase {
    float eye_y, pitch_pixels, base, falloff, homogeneous;
};

TEST_P(VolumetricsSunClosedForm, HeightMediumAgreesWithQuadrature) {
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.4F, -0.6F, 0.2F));
    host.sun_illuminance = glm::vec3(1000);
    host.size = {1, 9};
    host.vertical_fov = 1.6F;
    host.view_depth = [](int, int) { return 60.0F; };
    for (const bool light_transmittance : {true, false}) {
        for (const auto& [eye_y, falloff, homogeneous] :
             {std::tuple{0.0F, 8.0F, 0.0F}, {20.0F, 4.0F, 0.0F}, {5.0F, 20.0F, 0.01F}}) {
            host.eye = {0, eye_y, 0};
            host.global = {{.sigma_s = glm::vec3(0.04F),
                            .sigma_a = glm::vec3(0.02F),
                            .anisotropy = 0.3F,
                            .height = true,
                            .base = 1,
                            .falloff = falloff}};
            if (homogeneous > 0) host.global.push_back({.sigma_s = glm::vec3(homogeneous), .anisotropy = 0.3F});
            Settings settings = plain_settings(8);
            settings.light_transmittance = light_transmittance;
            const Frame frame = host.render(settings);
            for (int y = 0; y < 9; ++y) {
                const glm::dvec3 d = host.ray(0, y);
                const double length = 60 / -d.z;
                const double to_sun_y = -host.sun_direction.y;
                const auto density = [&](double h) { return std::exp(-(h - 1) / falloff); };
                const auto depth_to = [&](double t) {  // closed form of the density's integral, on its own
                    const double k = d.y / falloff;
                    const double mean = std::abs(k * t) < 1e-9 ? 1 : -std::expm1(-k * t) / (k * t);
                    return 0.06 * density(eye_y) * mean * t + homogeneous * t;
                };
                const auto integrand = [&](double t) {
                    const double h = eye_y + d.y * t;
                    const double sun = light_transmittance ? 0.06 * density(h) * falloff / to_sun_y : 0;
                    return (0.04 * density(h) + homogeneous) * std::exp(-depth_to(t) - sun);
                };
                const double cos_theta = -glm::dot(glm::dvec3(host.sun_direction), d);
                const double expected = 1000 * phase_hg(0.3, cos_theta) * integrate(integrand, 0, length);
                // One medium is exact, a mixture is not; nor is what lies between columns of froxels or sheets.
                const double one_medium = GetParam() == "froxel"       ? 0.007
                                          : GetParam() == "billboards" ? 0.015
                                                                       : 1e-3;
                EXPECT_LE(relative(frame.scattering.at(0, 8 - y)[0], expected), homogeneous > 0 ? 0.02 : one_medium)
                    << "falloff " << falloff << " pixel " << y << ' ' << frame.scattering.at(0, 8 - y)[0] << " for "
                    << expected;
                const double transmittance = std::exp(-depth_to(length));
                EXPECT_NEAR(frame.transmittance.at(0, 8 - y)[0], transmittance, 1e-3 * transmittance + 3e-8);
            }
        }
    }
}

TEST_P(VolumetricsClosedForm, FogGoesOnBehindTheMarch) {
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(1000);
    host.sun_direction = {0, -1, 0};
    Settings settings = plain_settings(8);
    settings.max_distance = settings.froxel_far = 50;
    host.size = {2, 1};
    host.vertical_fov = 0.001F;
    host.view_depth = [](int x, int) { return x == 0 ? 300.0F : sky; };
    host.global = {{.sigma_s = glm::vec3(0.005F), .sigma_a = glm::vec3(0.005F)}};
    const Frame frame = host.render(settings);
    const double saturated = 1000 * 0.5 / (4 * pi);
    EXPECT_LE(relative(frame.scattering.at(0, 0)[0], saturated * -std::expm1(-3.0)), 1e-3);
    EXPECT_LE(relative(frame.transmittance.at(0, 0)[0], std::exp(-3.0)), tolerance());
    EXPECT_LE(relative(frame.scattering.at(1, 0)[0], saturated), 1e-3);
    EXPECT_EQ(frame.transmittance.at(1, 0)[0], 0);
}

TEST_P(VolumetricsClosedForm, HeightFogEndsTowardsTheSky) {
    host.size = {1, 3};
    host.vertical_fov = 1.0F;
    host.view_depth = [](int, int) { return sky; };
    host.global = {{.sigma_a = glm::vec3(0.02F), .height = true, .falloff = 10}};
    Settings settings = plain_settings(8);
    settings.max_distance = settings.froxel_far = 20;
    const Frame frame = host.render(settings);
    EXPECT_LE(relative(frame.transmittance.at(0, 0)[0], std::exp(-0.02 * 10 / host.ray(0, 2).y)), tolerance());
    EXPECT_EQ(frame.transmittance.at(0, 1)[0], 0);
    EXPECT_EQ(frame.transmittance.at(0, 2)[0], 0);
}

TEST_F(VolumetricsMarch, SteppingChangesNothingWhereAllIsInClosedForm) {
    host.has_sun = true;
    host.global = {{.sigma_s = glm::vec3(0.1F), .sigma_a = glm::vec3(0.1F), .height = true, .falloff = 3}};
    const Frame uniform = host.render(plain_settings(16));
    for (const float strength : {0.01F, 3.0F, 10.0F}) {
        Settings settings = plain_settings(16);
        settings.stepping = volumetrics::Stepping::exponential;
        settings.stepping_strength = strength;
        const Frame frame = host.render(settings);
        EXPECT_NEAR(frame.scattering.at(0, 0)[0], uniform.scattering.at(0, 0)[0],
                    1e-3 * uniform.scattering.at(0, 0)[0]);
        EXPECT_NEAR(frame.transmittance.at(0, 0)[0], uniform.transmittance.at(0, 0)[0], 2e-4);
    }
}

TEST_F(VolumetricsMarch, DitherMovesTheSamplesOverTheWholeStep) {
    // Half of the segment is in the shadow of the fence; the mean over a tile of 8 x 8 offsets finds the fraction.
    host.size = {8, 8};
    host.vertical_fov = 1e-4F;
    host.has_sun = true;
    host.sun_direction = {0, -1, 0};
    host.sun_illuminance = glm::vec3(1000);
    host.global = {{.sigma_s = glm::vec3(1e-4F)}};
    const Frame lit = host.render(plain_settings(1));
    host.shadows = 1;
    for (const auto dither : {volumetrics::Noise::bayer, volumetrics::Noise::white_tile}) {
        Settings settings = plain_settings(1);
        settings.noise = dither;
        const Frame frame = host.render(settings);
        int visible = 0;
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) visible += frame.scattering.at(x, y)[0] > 0.5F * lit.scattering.at(x, y)[0];
        int expected = 0;  // fract(0.21 z) < 0.6 at the middles of 64 strata
        for (int i = 0; i < 64; ++i) {
            const double z = -0.21 * 10 * (i + 0.5) / 64;
            expected += z - std::floor(z) < 0.6;
        }
        EXPECT_NEAR(visible, expected, 1);
    }
}

TEST_P(VolumetricsClosedForm, ExtremeParametersStayFiniteAndInRange) {
    host.size = {5, 7};
    host.vertical_fov = 2.6F;
    host.view_depth = [](int x, int y) { return x == 0 ? sky : std::pow(10.0F, static_cast<float>(y - 1)); };
    host.has_sun = true;
    host.ambient = glm::vec3(1e4F);
    host.lights = {point_light({0, 0, 0}, 1e6F), point_light({0, 0, -5}, 1e6F, 1e5F, 0),
                   spot_light({0, 0, 0}, {0, 0, -1}, 1e6F, 1, 0),
                   spot_light({1, 0, -3}, {-1, 0, 0}, 1e6F, 0.5F, 0.5F)};
    host.local = {{.half_extent = glm::vec3(100),
                   .sigma_s = glm::vec3(1e4F),
                   .anisotropy = 0.999F,
                   .emission = glm::vec3(1e6F)}};
    // A fault of theirs: 1e4 / m, a height medium's base 1e4 m above the eye, and anisotropy 0.999 under a sun of
    // 1e5 overflow, and are NaN or negative light.
    const bool overflows = GetParam() == "billboards" || GetParam() == "particles" || GetParam() == "reference";
    for (const glm::vec3 sun : {glm::vec3(0, -1, 0), {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {0, 0, 1}}) {
        for (const float sigma : {0.0F, 1e-30F, 1e-8F, 1.0F, 1e4F}) {
            if (overflows && sigma > 1) continue;
            for (const float g : {-0.999F, 0.999F}) {
                for (const float base : {-1e4F, 1e4F}) {
                    host.sun_direction = sun;
                    host.sun_illuminance = glm::vec3(1e5F);
                    host.global = {{.sigma_s = {sigma, sigma, 0}, .sigma_a = {0, sigma, sigma}, .anisotropy = g},
                                   {.sigma_s = glm::vec3(sigma),
                                    .anisotropy = -g,
                                    .emission = glm::vec3(1),
                                    .height = true,
                                    .base = base,
                                    .falloff = 0.01F}};
                    for (const auto lamps :
                         {volumetrics::LampIntegration::center, volumetrics::LampIntegration::segment}) {
                        if (lamps == volumetrics::LampIntegration::center && GetParam() != "ray_march" &&
                            GetParam() != "froxel")
                            continue;  // is the same
                        Settings settings = plain_settings(1);
                        settings.lamp_integration = lamps;
                        settings.filter = volumetrics::Filter::gaussian15;
                        settings.froxels_x = settings.froxels_y = settings.froxels_z = 8;
                        settings.reference_steps = 32;
                        const Frame frame = host.render(settings);
                        for (const float v : frame.scattering.pixels)
                            ASSERT_TRUE(std::isfinite(v) && v >= 0) << v << " at sigma " << sigma;
                        for (const float v : frame.transmittance.pixels) ASSERT_TRUE(v >= 0 && v <= 1) << v;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace tyndall::test
