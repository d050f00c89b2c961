// The technique reference against closed forms and integration in double precision.

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "engine/gl/readback.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::test {
namespace {

constexpr double pi = std::numbers::pi;

Settings reference_settings(int steps = 1024) {
    Settings settings;  // dither and blur as they are by default: they must not matter
    settings.technique = "reference";
    settings.reference_steps = steps;
    return settings;
}

double relative(double value, double expected) {
    return std::abs(value - expected) / std::abs(expected);
}

double mean_red(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x) sum += image.at(x, y)[0];
    return sum / (image.size.x * image.size.y);
}

double relative_rmse(const Image& image, const Image& expected) {
    double sum = 0;
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x) sum += std::pow(double(image.at(x, y)[0]) - expected.at(x, y)[0], 2);
    return std::sqrt(sum / (image.size.x * image.size.y)) / mean_red(expected);
}

/// A turned box or sphere in double precision, by planes and by the quadratic, not as the shaders do.
struct Solid {
    bool box;
    glm::dvec3 center, half;
    glm::dquat rotation{1, 0, 0, 0};
    double softness = 0;

    [[nodiscard]] double density(glm::dvec3 point) const {
        const glm::dvec3 p = glm::conjugate(rotation) * (point - center);
        const double depth =
            box ? std::min({half.x - std::abs(p.x), half.y - std::abs(p.y), half.z - std::abs(p.z)})
                : half.x - glm::length(p);
        return softness > 0 ? std::clamp(depth / softness, 0.0, 1.0) : depth > 0 ? 1.0 : 0.0;
    }
    /// Metres of density along a path, by 400 panels between its crossings of the shape.
    [[nodiscard]] double length(glm::dvec3 from, glm::dvec3 to) const {
        const glm::dvec3 path = to - from;
        double enter = 0, leave = 1;
        if (box) {
            for (int axis = 0; axis < 3; ++axis)
                for (const double side : {-1.0, 1.0}) {
                    glm::dvec3 normal(0);
                    normal[axis] = side;
                    normal = rotation * normal;
                    const double outside = glm::dot(from - center, normal) - half[axis];
                    const double slope = glm::dot(path, normal);
                    if (slope < 0) enter = std::max(enter, outside / -slope);
                    if (slope > 0) leave = std::min(leave, -outside / slope);
                    if (slope == 0 && outside > 0) return 0;
                }
        } else {
            const double a = glm::dot(path, path), b = glm::dot(from - center, path),
                         c = glm::dot(from - center, from - center) - half.x * half.x, d = b * b - a * c;
            if (d <= 0) return 0;
            enter = std::max(enter, (-b - std::sqrt(d)) / a);
            leave = std::min(leave, (-b + std::sqrt(d)) / a);
        }
        if (enter >= leave) return 0;
        if (softness <= 0) return (leave - enter) * glm::length(path);
        return glm::length(path) *
               integrate_panels([&](double s) { return density(from + path * s); }, enter, leave, 16);
    }
    [[nodiscard]] LocalMedium medium(float sigma_s, float sigma_a, float g = 0) const {
        return {.shape = box ? Shape::box : Shape::ellipsoid,
                .center = center,
                .half_extent = half,
                .rotation = rotation,
                .softness = static_cast<float>(softness),
                .sigma_s = glm::vec3(sigma_s),
                .sigma_a = glm::vec3(sigma_a),
                .anisotropy = g};
    }
};

const Solid turned_box{.box = true,
                       .center = {0.3, -0.2, -6},
                       .half = {1.5, 1, 2},
                       .rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)))};
const Solid ball{.box = false, .center = {0.3, -0.2, -6}, .half = glm::dvec3(2)};

class VolumetricsReference : public GlTest {
  protected:
    VolumetricsReference() {
        host.view_depth = [](int, int) { return 20.0F; };
    }
    StubHost host;

    /// Red radiance of what one shape scatters of light whose strength at a point, phase included, is `light`.
    template <class Light>
    [[nodiscard]] static double scattered(const Solid& shape, double sigma_s, double sigma_t, glm::dvec3 direction,
                                          double end, const Light& light) {
        const auto integrand = [&](double t) {
            const glm::dvec3 point = direction * t;
            const double density = shape.density(point);
            if (density <= 0) return 0.0;
            return sigma_s * density * std::exp(-sigma_t * shape.length(glm::dvec3(0), point)) * light(point);
        };
        return integrate_panels(integrand, 0, end, 2000);
    }
};

TEST_F(VolumetricsReference, HomogeneousSlabIsExactForEachChannel) {
    host.view_depth = [](int, int) { return 10.0F; };
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.3F, -0.5F, 0.6F));
    host.sun_illuminance = {10000, 20000, 40000};
    host.ambient = {3, 2, 1};
    for (const double sigma : {1e-6, 0.01, 0.3, 3.0}) {
        const auto s = static_cast<float>(sigma);
        host.global = {{.sigma_s = glm::vec3(s),
                        .sigma_a = glm::vec3(0, s, 2 * s),
                        .anisotropy = 0.5F,
                        .emission = {5, 6, 7}}};
        const Frame frame = host.render(reference_settings());
        for (int c = 0; c < 3; ++c) {
            const double sigma_t = sigma * (c + 1);
            const double source =
                sigma * (host.sun_illuminance[c] * phase_hg(0.5, host.sun_direction.z) + host.ambient[c]) + 5 + c;
            EXPECT_LE(relative(frame.scattering.at(0, 0)[c], source * -std::expm1(-sigma_t * 10) / sigma_t), 2e-5)
                << sigma_t;
            EXPECT_NEAR(frame.transmittance.at(0, 0)[c], std::exp(-sigma_t * 10),
                        2e-5 * std::exp(-sigma_t * 10) + 1e-12);
        }
    }
}

TEST_F(VolumetricsReference, HeightMediumIsLitThroughItself) {
    host.size = {3, 5};
    host.eye = {0, 2, 0};
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.5F, -0.8F, 0.3F));
    host.sun_illuminance = glm::vec3(1000);
    host.global = {{.sigma_s = glm::vec3(0.1F),
                    .sigma_a = glm::vec3(0.05F),
                    .anisotropy = -0.4F,
                    .height = true,
                    .base = 1,
                    .falloff = 3}};
    const Frame frame = host.render(reference_settings());
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 3; ++x) {
            const glm::dvec3 d = host.ray(x, y);
            const auto density = [&](double t) { return std::exp(-(2 + d.y * t - 1) / 3); };
            const auto depth = [&](double t) { return 0.15 * integrate_panels(density, 0, t, 4); };
            const auto integrand = [&](double t) {
                return 0.1 * density(t) * std::exp(-depth(t) - 0.15 * density(t) * 3 / -host.sun_direction.y);
            };
            const double phase = phase_hg(-0.4, -glm::dot(glm::dvec3(host.sun_direction), d));
            const double expected = 1000 * phase * integrate_panels(integrand, 0, 20 / -d.z, 50);
            EXPECT_LE(relative(frame.scattering.at(x, 4 - y)[0], expected), 1e-4) << x << ' ' << y;
            EXPECT_LE(relative(frame.transmittance.at(x, 4 - y)[0], std::exp(-depth(20 / -d.z))), 1e-4);
        }
}

TEST_F(VolumetricsReference, TailBehindTheSamplesIsClosed) {
    host.view_depth = [](int, int) { return sky; };
    host.has_sun = true;
    host.global = {{.sigma_s = glm::vec3(0.02F), .sigma_a = glm::vec3(0.01F)}};
    Settings settings = reference_settings();
    settings.max_distance = 30;
    const Frame frame = host.render(settings);
    EXPECT_LE(relative(frame.scattering.at(0, 0)[0], 2.0 / 3 / (4 * pi)), 1e-4);
    EXPECT_EQ(frame.transmittance.at(0, 0)[0], 0);
}

// By hand: the sun stands above a box whose top is 1.5 m over the ray, which crosses 4 m of it.
TEST_F(VolumetricsReference, SunIsAttenuatedInsideABox) {
    host.has_sun = true;
    host.local = {{.shape = Shape::box,
                   .center = {0, 0.5F, -8},
                   .half_extent = {1, 1, 2},
                   .sigma_s = glm::vec3(0.5F),
                   .sigma_a = glm::vec3(0, 0.25F, 0.5F)}};
    Settings settings = reference_settings(64);
    for (const bool light_transmittance : {true, false}) {
        settings.light_transmittance = light_transmittance;
        const Frame frame = host.render(settings);
        for (int c = 0; c < 3; ++c) {
            const double sigma_t = 0.5 + 0.25 * c;
            const double expected = 0.5 / (4 * pi) * -std::expm1(-sigma_t * 4) / sigma_t *
                                    (light_transmittance ? std::exp(-sigma_t * 1.5) : 1);
            EXPECT_LE(relative(frame.scattering.at(0, 0)[c], expected), 1e-5);
            EXPECT_LE(relative(frame.transmittance.at(0, 0)[c], std::exp(-sigma_t * 4)), 1e-5);
        }
    }
}

TEST_F(VolumetricsReference, ShapesAgreeWithQuadrature) {
    host.size = {4, 4};
    host.vertical_fov = 0.5F;
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.6F, -0.5F, -0.4F));
    host.sun_illuminance = glm::vec3(100);
    const glm::dvec3 to_sun = -host.sun_direction;
    Solid soft_ball = ball;
    soft_ball.softness = 0.8;
    for (const Solid& shape : {turned_box, ball, soft_ball}) {
        host.local = {shape.medium(0.4F, 0.2F, 0.3F)};
        const Frame frame = host.render(reference_settings());
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                const glm::dvec3 d = host.ray(x, y);
                const double phase = 100 * phase_hg(0.3, glm::dot(to_sun, d));
                const double expected = scattered(shape, 0.4, 0.6, d, 12, [&](glm::dvec3 p) {
                    return phase * std::exp(-0.6 * shape.length(p, p + 50.0 * to_sun));
                });
                EXPECT_NEAR(frame.scattering.at(x, 3 - y)[0], expected, 1e-3 * expected + 1e-6) << x << ' ' << y;
            }
    }
}

TEST_F(VolumetricsReference, MediumOutOfViewStandsBetweenSunAndView) {
    host.has_sun = true;
    host.global = {{.sigma_s = glm::vec3(0.01F)}};
    const double clear = host.render(reference_settings(64)).scattering.at(0, 0)[0];
    host.local = {
        {.shape = Shape::box, .center = {0, 60, 0}, .half_extent = {90, 2, 90}, .sigma_a = glm::vec3(0.25F)}};
    EXPECT_LE(relative(host.render(reference_settings(64)).scattering.at(0, 0)[0], clear * std::exp(-1.0)), 1e-5);
}

TEST_F(VolumetricsReference, LampsAgreeWithQuadrature) {
    host.size = {4, 2};
    host.global = {{.sigma_s = glm::vec3(0.03F), .sigma_a = glm::vec3(0.02F), .anisotropy = 0.4F}};
    host.slices = 4;
    host.slice_depth = 5;
    const shared::GpuLight lamps[] = {
        point_light({0.5F, 0.2F, -7}, 1000, 12),
        spot_light({2, 3, -8}, {-0.6F, -1, 0.1F}, 1000, std::cos(0.3F), std::cos(0.7F)),
    };
    for (const shared::GpuLight& lamp : lamps) {
        host.lights = {lamp};
        const Frame frame = host.render(reference_settings());
        const glm::dvec3 position(lamp.position_range), axis(lamp.direction_type);
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 4; ++x) {
                const glm::dvec3 d = host.ray(x, y);
                const auto integrand = [&](double t) {
                    const glm::dvec3 from = d * t - position;
                    const double distance = glm::length(from);
                    const double window = 1 - std::pow(distance / lamp.position_range.w, 4);
                    if (window <= 0) return 0.0;
                    double value = 1000 * window / (distance * distance);
                    if (lamp.direction_type.w == LIGHT_SPOT)
                        value *= std::pow(
                            std::clamp(glm::dot(from, axis) / distance * lamp.cone_shadow.x + lamp.cone_shadow.y,
                                       0.0, 1.0),
                            2);
                    return value * 0.03 * phase_hg(0.4, -glm::dot(from, d) / distance) *
                           std::exp(-0.05 * (t + distance));
                };
                const double expected = integrate_panels(integrand, 0, 20 / -d.z, 4000);
                EXPECT_NEAR(frame.scattering.at(x, 1 - y)[0], expected, 5e-4 * expected + 1e-6) << x << ' ' << y;
            }
    }
}

TEST_F(VolumetricsReference, LampLightIsAttenuatedByShapes) {
    host.size = {4, 4};
    host.vertical_fov = 0.5F;
    const glm::dvec3 lamp(2.8, 1.5, -5);
    host.lights = {point_light(lamp, 1000)};
    Solid soft_ball = ball;
    soft_ball.softness = 0.8;
    Settings settings = reference_settings();
    settings.reference_light_steps = 64;
    for (const Solid& shape : {turned_box, soft_ball}) {
        host.local = {shape.medium(0.4F, 0.2F)};
        const Frame frame = host.render(settings);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                const glm::dvec3 d = host.ray(x, y);
                const double expected = scattered(shape, 0.4, 0.6, d, 12, [&](glm::dvec3 p) {
                    const double distance = glm::distance(p, lamp);
                    return 1000 / (4 * pi) / (distance * distance) * std::exp(-0.6 * shape.length(p, lamp));
                });
                EXPECT_NEAR(frame.scattering.at(x, 3 - y)[0], expected, 1e-3 * expected + 1e-6) << x << ' ' << y;
            }
    }
}

// 5,000 lamps at one place are one lamp 5,000 times as bright: none is lost where a dispatch cannot hold them all.
TEST_F(VolumetricsReference, LampsThatNeedManyDispatchesAreAllThere) {
    host.size = {16, 2};
    host.global = {{.sigma_s = glm::vec3(0.01F)}};
    host.slices = 5;
    host.slice_depth = 4;
    Settings settings = reference_settings(64);
    host.lights = {point_light({1, 0, -9}, 1000)};
    const Frame one = host.render(settings);
    host.lights.assign(5000, point_light({1, 0, -9}, 0.2F));
    const Frame many = host.render(settings);
    for (int x = 0; x < 16; ++x)
        EXPECT_LE(relative(many.scattering.at(x, 0)[0], one.scattering.at(x, 0)[0]), 1e-4) << x;
}

TEST_F(VolumetricsReference, StepsLoseNoLightOfManyLamps) {
    host.size = {8, 4};
    host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.005F)}};
    host.slices = 8;
    host.slice_depth = 2.5F;
    for (int i = 0; i < 200; ++i)
        host.lights.push_back(
            point_light({std::fmod(2.399F * static_cast<float>(i), 8.0F) - 4,
                         std::fmod(1.713F * static_cast<float>(i), 6.0F) - 3, -0.1F * static_cast<float>(i) - 1},
                        100, 6));
    Settings settings = reference_settings(256);
    settings.reference_lamp_samples = 8;
    const Frame coarse = host.render(settings);
    settings.reference_steps = 4096;
    settings.reference_lamp_samples = 4;
    EXPECT_LE(relative_rmse(coarse.scattering, host.render(settings).scattering), 1e-3);
}

TEST_F(VolumetricsReference, LightIsLinear) {
    host.size = {8, 4};
    host.has_sun = true;
    host.shadows = 1;
    host.ambient = glm::vec3(0.1F);
    host.global = {{.sigma_s = glm::vec3(0.02F), .height = true, .falloff = 2}};
    host.local = {turned_box.medium(0.3F, 0.1F)};
    host.lights = {point_light({1, 0, -5}, 3)};
    const Frame single = host.render(reference_settings(256));
    host.sun_illuminance *= 2;
    host.ambient *= 2.0F;
    host.lights[0].intensity_radius *= glm::vec4(2, 2, 2, 1);
    const Frame twice = host.render(reference_settings(256));
    for (int x = 0; x < 8; ++x)
        EXPECT_LE(relative(twice.scattering.at(x, 1)[0], 2.0 * single.scattering.at(x, 1)[0]), 1e-6);
}

TEST_F(VolumetricsReference, ShadowsConvergeWithSteps) {
    host.size = {32, 18};
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.4F, -0.8F, 0.3F));
    host.shadows = 1;
    host.view_depth = [](int, int) { return 200.0F; };
    host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.005F)}};
    const Image best = host.render(reference_settings(16384)).scattering;
    const double coarse = relative_rmse(host.render(reference_settings(256)).scattering, best);
    const double fine = relative_rmse(host.render(reference_settings(1024)).scattering, best);
    EXPECT_LE(fine, 5e-3);
    EXPECT_LE(3 * fine, coarse);  // in proportion would be 4
}

TEST_F(VolumetricsReference, RayMarchTendsToIt) {
    host.size = {32, 18};
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.4F, -0.8F, 0.3F));
    host.sun_illuminance = glm::vec3(50);
    host.shadows = 1;
    host.view_depth = [](int x, int) { return x < 8 ? sky : 20.0F + static_cast<float>(x); };
    host.ambient = glm::vec3(1);
    host.lights = {point_light({1, 0.5F, -6}, 100), point_light({-3, 0.5F, -12}, 200, 9)};
    host.global = {{.sigma_s = glm::vec3(0.005F), .sigma_a = glm::vec3(0.005F), .anisotropy = 0.3F},
                   {.sigma_s = glm::vec3(0.01F), .anisotropy = -0.2F, .height = true, .falloff = 4}};
    const Frame marched = host.render(plain_settings(1024));
    const Frame frame = host.render(reference_settings());
    EXPECT_LE(relative_rmse(marched.scattering, frame.scattering), 5e-3);
    EXPECT_LE(relative_rmse(marched.transmittance, frame.transmittance), 1e-3);
}

TEST_F(VolumetricsReference, IsOnePassWhereThereIsAMediumElseNone) {
    EXPECT_THAT(host.render(reference_settings()).live_passes, ::testing::IsEmpty());
    host.local = {{.center = {0, 0, 30}, .sigma_a = glm::vec3(1)}};
    EXPECT_THAT(host.render(reference_settings()).live_passes, ::testing::IsEmpty());
    host.global = {{.sigma_s = glm::vec3(0.1F)}};
    const Frame frame = host.render(reference_settings());
    EXPECT_THAT(frame.live_passes, ::testing::ElementsAre("volumetrics/reference"));
    EXPECT_EQ(frame.skipped.at("volumetrics/march"), "technique is reference");
}

TEST_F(VolumetricsReference, IsComposited) {
    host.size = {4, 4};
    host.vertical_fov = 1e-3F;
    host.view_depth = [](int, int) { return 10.0F; };
    host.ambient = glm::vec3(1);
    host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = {0, 0.1F, 0.3F}}};
    gl::Texture color({.format = GL_RGBA16F, .size = {4, 4, 1}}, "color");
    color.clear_float(8, 8, 8, 1);
    PassList passes;
    const Inputs inputs = host.inputs(passes);
    host.volumetrics().prepare(inputs, reference_settings(64));
    const volumetrics::Outputs outputs = host.volumetrics().add_passes(passes, inputs, reference_settings(64));
    passes.export_texture(host.volumetrics().composite(passes, outputs, passes.import("color", color)));
    passes.compile();
    TransientPool pool;
    passes.execute(pool);
    const Image image = gl::read_texture(color);
    for (int c = 0; c < 3; ++c) {
        const double sigma_t = std::array{0.05, 0.15, 0.35}[static_cast<std::size_t>(c)];
        const double expected = 0.05 / sigma_t * -std::expm1(-sigma_t * 10) + 8 * std::exp(-sigma_t * 10);
        EXPECT_NEAR(image.at(1, 1)[c], expected, 2e-3 * expected);
    }
}

}  // namespace
}  // namespace tyndall::test
