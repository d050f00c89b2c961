// Technique shaft_geometry: sunlight behind an occluder of known shape, against integration in double precision.

#include <algorithm>
#include <cmath>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/low_resolution.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::test {
namespace {

struct Error {
    double rms = 0;      ///< root mean square over the picture, relative to its mean
    double largest = 0;  ///< largest difference, relative to the mean
    double mean = 0;
};

class VolumetricsShaftGeometry : public GlTest {
  protected:
    StubHost host;
    Settings settings = plain_settings(1);

    void SetUp() override {
        settings.technique = "shaft_geometry";
        settings.shaft_grid = 64;
        settings.max_distance = 400;  // a ray to the sky is integrated as far
        host.size = {32, 18};
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.3F, -1, 0.2F));
        host.sun_illuminance = glm::vec3(10);
        host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.4F}};
        host.shadows = 3;
        host.view_depth = [](int x, int y) { return x % 5 == 4 ? sky : 4.0F + static_cast<float>(x + y); };
    }

    [[nodiscard]] double surface(int x, int y, glm::dvec3 ray) const {
        const double depth = host.view_depth(x, y);
        return depth == sky ? 400 : depth / -ray.z;
    }
    /// The part of a ray in the shadow of the half plane y = 4, x < 0; empty where x >= y.
    [[nodiscard]] glm::dvec2 shadow(glm::dvec3 ray) const {
        const glm::dvec3 eye = host.eye, d = host.sun_direction;
        glm::dvec2 part(0, 1e9);
        const auto keep_below_zero = [&](double at_eye, double rate) {
            if (rate > 0) part.y = std::min(part.y, -at_eye / rate);
            if (rate < 0) part.x = std::max(part.x, -at_eye / rate);
            if (rate == 0 && at_eye >= 0) part.y = -1;
        };
        keep_below_zero(eye.y - 4, ray.y);
        keep_below_zero(eye.x - d.x / d.y * (eye.y - 4), ray.x - d.x / d.y * ray.y);
        return part;
    }
    /// int_a^b of the light that one point of the ray sends to the eye, along the red channel.
    [[nodiscard]] double sunlight(glm::dvec3 ray, double a, double b) const {
        const glm::dvec3 eye = host.eye, to_sun = -host.sun_direction;
        const auto integrand = [&](double t) {
            double source = 0, weighted = 0, depth = 0;
            for (const GlobalMedium& m : host.global) {
                const double sigma_t = m.sigma_s.r + m.sigma_a.r;
                const double at_eye = m.height ? std::exp((m.base - eye.y) / m.falloff) : 1;
                const double rise = ray.y * t / m.falloff;
                const double density = m.height ? at_eye * std::exp(-rise) : 1;
                const double mean = !m.height               ? 1
                                    : std::abs(rise) < 1e-9 ? at_eye
                                                            : -at_eye * std::expm1(-rise) / rise;
                depth += sigma_t * mean * t;
                if (m.height) depth += sigma_t * density * m.falloff / to_sun.y;  // towards the sun
                source += m.sigma_s.r * density;
                weighted += m.sigma_s.r * density * m.anisotropy;
            }
            // Anisotropies are averaged by scattering.
            return source * phase_hg(weighted / source, glm::dot(to_sun, ray)) * host.sun_illuminance.r *
                   std::exp(-depth);
        };
        return a < b ? integrate(integrand, a, b, 1e-9) : 0;
    }
    [[nodiscard]] double expected(int x, int y) const {
        const glm::dvec3 ray = host.ray(x, y);
        const double end = surface(x, y, ray);
        const glm::dvec2 dark = host.shadows == 3 ? shadow(ray) : glm::dvec2(1, 0);
        if (dark.x >= dark.y || dark.x >= end) return sunlight(ray, 0, end);
        return sunlight(ray, 0, dark.x) + sunlight(ray, std::min(dark.y, end), end);
    }
    [[nodiscard]] Error error() {
        const Frame frame = host.render(settings);
        Error result;
        double squares = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                const double value = frame.scattering.at(x, host.size.y - 1 - y)[0], truth = expected(x, y);
                EXPECT_TRUE(std::isfinite(value) && value >= 0);
                result.mean += truth;
                squares += (value - truth) * (value - truth);
                result.largest = std::max(result.largest, std::abs(value - truth));
            }
        const double n = host.size.x * host.size.y;
        result.mean /= n;
        result.rms = std::sqrt(squares / n) / result.mean;
        result.largest /= result.mean;
        return result;
    }
};

TEST_F(VolumetricsShaftGeometry, WithoutOccludersIsTheClosedForm) {
    host.shadows = 0;
    for (const glm::vec3 sun : {glm::vec3(0.3F, -1, 0.2F), glm::vec3(0.1F, -0.1F, 1), glm::vec3(0.1F, -0.1F, -1)}) {
        host.sun_direction = glm::normalize(sun);  // from above; before the eye; behind it
        const Error e = error();
        EXPECT_LE(e.largest, 1e-3) << sun.z;
    }
}

TEST_F(VolumetricsShaftGeometry, ShadowOfAHalfPlaneConvergesWithTheGrid) {
    // The eye in the light beside the shadow, in the shadow, and above both.
    for (const glm::vec3 eye : {glm::vec3(4, 0, 0), glm::vec3(-1, 1, 0), glm::vec3(-3, 9, 0)}) {
        host.eye = eye;
        std::vector<double> errors;
        for (int grid : {32, 128, 512}) {
            settings.shaft_grid = grid;
            errors.push_back(error().rms);
        }
        EXPECT_LE(errors[1], 0.4 * errors[0]) << eye.x;
        EXPECT_LE(errors[2], 0.4 * errors[1]) << eye.x;
        EXPECT_LE(errors[2], 0.005) << eye.x;
    }
}

TEST_F(VolumetricsShaftGeometry, ShadowIsRightTowardsAndAwayFromTheSun) {
    settings.shaft_grid = 256;
    for (const float z : {1.0F, -1.0F}) {
        host.sun_direction = glm::normalize(glm::vec3(0.1F, -0.3F, z));
        for (const float x : {2.0F, -2.0F}) {
            host.eye = {x, 1, 0};
            const Error e = error();
            EXPECT_LE(e.rms, 0.02) << z << ' ' << x;
        }
    }
}

TEST_F(VolumetricsShaftGeometry, NoLightWhereAllThatIsSeenIsInShadow) {
    host.eye = {-60, -20, 0};
    host.view_depth = [](int, int) { return 10.0F; };
    const Frame frame = host.render(settings);
    host.shadows = 0;
    const Frame lit = host.render(settings);
    for (int y = 0; y < host.size.y; ++y)
        for (int x = 0; x < host.size.x; ++x)
            EXPECT_LE(frame.scattering.at(x, y)[0], 1e-5 * lit.scattering.at(x, y)[0]) << x << ' ' << y;
}

TEST_F(VolumetricsShaftGeometry, ShadowsTakeLightAwayAndSurfacesCutThem) {
    for (const float depth : {0.02F, 0.5F, 3.0F, 30.0F}) {
        host.view_depth = [depth](int, int) { return depth; };
        host.znear = 0.01F;
        host.eye = {1.3F, 0, 0};  // 0.1 m in the light
        settings.shaft_grid = 512;
        const Error e = error();
        EXPECT_LE(e.rms, 0.02) << depth;
        const Frame shadowed = host.render(settings);
        host.shadows = 0;
        const Frame lit = host.render(settings);
        host.shadows = 3;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                EXPECT_LE(shadowed.scattering.at(x, y)[0], lit.scattering.at(x, y)[0] * 1.001F);
                EXPECT_EQ(shadowed.scattering.at(x, y)[3], lit.scattering.at(x, y)[3]);
            }
    }
}

TEST_F(VolumetricsShaftGeometry, NearPlaneChangesNothing) {
    host.eye = {0.5F, 1, 0};
    host.znear = 1;
    const Frame far_plane = host.render(settings);
    host.znear = 0.01F;
    const Frame near_plane = host.render(settings);
    for (int y = 0; y < host.size.y; ++y)
        for (int x = 0; x < host.size.x; ++x)
            EXPECT_NEAR(far_plane.scattering.at(x, y)[0], near_plane.scattering.at(x, y)[0],
                        2e-3 * near_plane.scattering.at(x, y)[0] + 1e-6);
}

TEST_F(VolumetricsShaftGeometry, LinearInLight) {
    host.eye = {-1, 1, 0};
    const Frame one = host.render(settings);
    host.sun_illuminance *= 8.0F;
    const Frame eight = host.render(settings);
    for (int y = 0; y < host.size.y; ++y)
        for (int x = 0; x < host.size.x; ++x)
            EXPECT_NEAR(eight.scattering.at(x, y)[0], 8 * one.scattering.at(x, y)[0],
                        1e-3 * eight.scattering.at(x, y)[0] + 1e-5);
}

TEST_F(VolumetricsShaftGeometry, OneHeightMediumIsExactAndMixturesAreClose) {
    host.eye = {2, 1, 0};
    settings.shaft_grid = 256;
    const GlobalMedium fog{.sigma_s = glm::vec3(0.1F), .anisotropy = 0.2F, .height = true, .base = 1, .falloff = 3};
    const GlobalMedium haze{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.6F};
    host.shadows = 0;
    host.global = {fog};
    EXPECT_LE(error().largest, 2e-3);
    host.global = {fog, haze};
    settings.shaft_segments = 6;
    host.shadows = 0;
    const Error mixed = error();
    host.shadows = 3;
    const Error shadowed = error();
    EXPECT_LE(mixed.rms, 0.01);
    EXPECT_LE(shadowed.rms, 0.015);
    host.shadows = 0;
    settings.shaft_segments = 24;
    EXPECT_LE(error().largest, 3e-3);
}

/// A lamp in a homogeneous medium, and the half x < 0 of the plane z = -6, which shadows it where host.shadows
/// is 2.
class VolumetricsShaftLamps : public VolumetricsShaftGeometry {
  protected:
    void SetUp() override {
        VolumetricsShaftGeometry::SetUp();
        host.has_sun = false;
        host.shadows = 0;
        host.eye = {0, 1, 2};
        host.view_depth = [](int x, int y) { return 6.0F + 0.5F * static_cast<float>(x + y); };
        host.global = {{.sigma_s = glm::vec3(0.03F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.2F}};
    }
    [[nodiscard]] double lamp_light(int x, int y) const {
        const shared::GpuLight& light = host.lights[0];
        const glm::dvec3 eye = host.eye, ray = host.ray(x, y), position(light.position_range),
                         axis(light.direction_type);
        const double range = light.position_range.w, sigma_t = 0.04;
        const auto integrand = [&](double t) {
            const glm::dvec3 v = eye + ray * t - position;
            const double d = glm::length(v);
            if (d >= range) return 0.0;
            double value = (1 - std::pow(d / range, 4)) / std::max(d * d, 1e-4);
            const double cone = glm::dot(v, axis) / d * light.cone_shadow.x + light.cone_shadow.y;
            value *= std::pow(std::clamp(cone, 0.0, 1.0), 2);
            const double s = (-6 - position.z) / v.z;
            if (host.shadows == 2 && s > 0 && s < 1 && position.x + s * v.x < 0) return 0.0;
            return value * light.intensity_radius.r * 0.03 * phase_hg(0.2, -glm::dot(v, ray) / d) *
                   std::exp(-sigma_t * (t + d));
        };
        return integrate_panels(integrand, 0, host.view_depth(x, y) / -ray.z, 200);
    }
    [[nodiscard]] double lamp_error() {
        const Frame frame = host.render(settings);
        double squares = 0, mean = 0;
        const double n = host.size.x * host.size.y;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                const double truth = lamp_light(x, y);
                squares += std::pow(frame.scattering.at(x, host.size.y - 1 - y)[0] - truth, 2) / n;
                mean += truth / n;
            }
        return std::sqrt(squares) / mean;
    }
};

TEST_F(VolumetricsShaftLamps, ConesAndSpheresAreClosedForms) {
    // From beside, towards the eye with the eye in the cone, away from it, and a lamp that shines everywhere.
    host.lights = {spot_light({-3, 2, -5}, {1, -0.2F, -0.1F}, 1000, 0.95F, 0.8F, 12)};
    EXPECT_LE(lamp_error(), 0.01);
    host.lights = {spot_light({0.3F, 1.2F, -6}, {0, 0, 1}, 1000, 0.95F, 0.8F, 20)};
    EXPECT_LE(lamp_error(), 0.01);
    host.lights = {spot_light({0.3F, 1.2F, -3}, {0.1F, 0, -1}, 1000, 0.95F, 0.8F, 20)};
    EXPECT_LE(lamp_error(), 0.01);
    host.lights = {point_light({1, 2, -6}, 1000, 6)};
    EXPECT_LE(lamp_error(), 0.01);
}

TEST_F(VolumetricsShaftLamps, ShadowsConvergeWithTheParts) {
    host.shadows = 2;
    host.lights = {point_light({0.5F, 1, -3}, 1000, 30)};
    settings.shaft_lamp_parts = 2;
    const double few = lamp_error();
    settings.shaft_lamp_parts = 16;
    const double many = lamp_error();
    EXPECT_LE(many, 0.4 * few);
    EXPECT_LE(many, 0.03);
}

TEST_F(VolumetricsShaftLamps, MeanOverFramesIsTheShadowOfEachPart) {
    host.shadows = 2;
    host.lights = {point_light({0.5F, 1, -3}, 1000, 30)};
    settings.shaft_lamp_parts = 4;
    const double fixed = lamp_error();
    settings.noise = volumetrics::Noise::bayer;
    settings.noise_time = volumetrics::NoiseTime::golden_ratio;
    settings.temporal = volumetrics::Temporal::accumulate;
    settings.temporal_clip = settings.temporal_reject = false;
    for (; host.frame_index < 33; ++host.frame_index) (void)host.render(settings);
    EXPECT_LE(lamp_error(), 0.3 * fixed);
}

TEST_F(VolumetricsShaftLamps, TheFilterTakesTheLampsVisibilityAlone) {
    host.has_sun = true;
    host.shadows = 3;  // of the sun
    host.eye = {2, 1, 0};
    host.sun_illuminance = glm::vec3(100);
    host.lights = {point_light({1, 2, -6}, 100, 6)};
    host.lights[0].cone_shadow.z = -1;  // it casts none
    settings.noise = volumetrics::Noise::white;
    const Image sharp = host.render(settings).scattering;
    settings.filter = volumetrics::Filter::gaussian15;
    const Frame apart = host.render(settings);
    EXPECT_LT(largest_difference(apart.scattering, sharp), 3e-3) << "the lamp is seen from everywhere";
    settings.reconstruct = volumetrics::Reconstruct::light;
    EXPECT_GT(largest_difference(host.render(settings).scattering, sharp), 0.1) << "edges of the sun's shafts";
    host.lights.clear();
    const Frame none = host.render(settings);
    EXPECT_EQ(none.skipped.at("volumetrics/filter_vertical"), "pixels sample nothing");
    EXPECT_EQ(none.skipped.at("volumetrics/relight"), "no lamps");
}

TEST_F(VolumetricsShaftLamps, LowerResolutionIsTheSameWhereLightIsSmooth) {
    host.has_sun = true;
    host.vertical_fov = 0.1F;
    host.view_depth = [](int, int) { return 12.0F; };
    host.lights = {point_light({3, 4, -9}, 100, 30)};
    host.lights[0].cone_shadow.z = -1;
    for (const int shadows : {0, 3}) {  // the sun everywhere or, from here, nowhere
        host.shadows = shadows;
        host.eye = {-9, 0, 2};
        for (const glm::ivec2 size : low_resolution_sizes) {
            host.size = size;
            settings.resolution = volumetrics::Resolution::full;
            const Image full = host.render(settings).scattering;
            for (const auto resolution : {volumetrics::Resolution::half, volumetrics::Resolution::quarter}) {
                settings.resolution = resolution;
                const double tolerance = resolution == volumetrics::Resolution::half ? 0.03 : 0.06;
                EXPECT_LT(largest_difference(host.render(settings).scattering, full), tolerance) << size.x << " px";
            }
        }
    }
}

TEST_F(VolumetricsShaftGeometry, ExtremesStayFinite) {
    host.lights = {point_light({1e5F, 3, -1e5F}, 1e8F, 100, 0)};
    for (const float distance : {1.0F, 1e5F})
        for (const float sigma : {1e-9F, 1e3F})
            for (const glm::vec3 sun :
                 {glm::vec3(0, -1, 0), glm::vec3(0, 0, -1), glm::vec3(0, 1e-3F, 1), glm::vec3(0, 1, 0)}) {
                if (sigma == 1e3F) reconstruct_all(settings);
                settings.max_distance = distance;
                settings.shaft_grid = 16;
                host.sun_direction = glm::normalize(sun);
                host.sun_illuminance = glm::vec3(1e6F);
                host.eye = {1e5F, 3, -1e5F};
                host.global = {
                    {.sigma_s = glm::vec3(sigma, 2 * sigma, sigma)},
                    {.sigma_s = glm::vec3(sigma), .height = true, .base = -100, .falloff = distance * sigma}};
                const Frame frame = host.render(settings);
                for (int y = 0; y < host.size.y; ++y)
                    for (int x = 0; x < host.size.x; ++x)
                        for (int c = 0; c < 4; ++c) {
                            const float value = frame.scattering.at(x, y)[c];
                            ASSERT_TRUE(value >= 0 && value <= 65504) << value << ' ' << distance << ' ' << sigma;
                        }
            }
}

TEST_F(VolumetricsShaftGeometry, SkipsWhatIsNotThere) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(host.render(settings).live_passes,
              (Names{"volumetrics/shaft_mesh", "volumetrics/shaft_faces", "volumetrics/shaft_resolve"}));
    host.has_sun = false;
    Frame frame = host.render(settings);
    EXPECT_EQ(frame.live_passes, (Names{"volumetrics/shaft_resolve"}));
    EXPECT_EQ(frame.skipped.at("volumetrics/shaft_mesh"), "no sun");
    host.global.clear();
    host.local = {{.center = {0, 0, -5}, .sigma_s = glm::vec3(1)}};
    frame = host.render(settings);
    EXPECT_TRUE(frame.live_passes.empty());
    EXPECT_EQ(frame.skipped.at("volumetrics/shaft_resolve"), "no global medium");
    EXPECT_FALSE(frame.scattering.size.x > 0);
}

}  // namespace
}  // namespace tyndall::test
