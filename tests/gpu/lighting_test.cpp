#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/files.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

constexpr double pi = std::numbers::pi;
constexpr glm::ivec2 size(64, 64);

/// glTF 2.0 appendix B for a dielectric of roughness 1, in its own words: alpha = 1, D = 1/pi, and Smith's term for
/// alpha = 1 is 1 / (2 (n.l + n.v)).
double rough_dielectric(double albedo, glm::dvec3 n, glm::dvec3 v, glm::dvec3 l) {
    const double n_l = glm::dot(n, l), n_v = glm::dot(n, v);
    if (n_l <= 0) return 0;
    const double v_h = glm::dot(v, glm::normalize(v + l));
    const double fresnel = 0.04 + 0.96 * std::pow(1 - v_h, 5);
    return (1 - fresnel) * albedo / pi + fresnel / pi / (2 * (n_l + n_v));
}

class Lighting : public GlTest {
  protected:
    Lighting() { options_.render.ambient = 0; }
    Image draw() {
        renderer_.prepare(builder_.finish());
        renderer_.render(builder_.scene, view_, size, options_);
        return renderer_.read_layer();
    }
    /// World point that a pixel (from the top) shows on the plane y = 0.
    [[nodiscard]] glm::dvec3 ground_at(int x, int y) const {
        const glm::vec2 ndc((static_cast<float>(x) + 0.5f) / size.x * 2 - 1,
                            1 - (static_cast<float>(y) + 0.5f) / size.y * 2);
        const glm::vec4 far = glm::inverse(view_.view_projection) * glm::vec4(ndc, 0.5f, 1);
        const glm::dvec3 eye(view_.eye), ray = glm::dvec3(far) / double{far.w} - eye;
        return eye - ray * (eye.y / ray.y);
    }
    template <class Expected>
    void expect_ground(const Image& image, Expected expected, double relative) {
        for (int y = 4; y < size.y; y += 8)
            for (int x = 4; x < size.x; x += 8) {
                const glm::dvec3 p = ground_at(x, y);
                const double wanted = expected(p, glm::normalize(glm::dvec3(view_.eye) - p));
                EXPECT_NEAR(image.at(x, y)[0], wanted, relative * wanted + 1e-6) << x << " " << y;
            }
    }

    test::SceneBuilder builder_;
    View view_ = look_at({0, 4, 1}, {0, 0, 0}, 1.0f, 0.1f, 1.0f);
    FrameOptions options_;
    ShaderLibrary& shaders_ = shared_shaders();
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shaders_, {&volumetrics_}};
    static constexpr glm::dvec3 up{0, 1, 0};
};

TEST_F(Lighting, PlaneUnderAPointLamp) {
    builder_.ground({0, 0, 0}, 20);
    builder_.point({0.5f, 2, -0.5f}, glm::vec3(100), 50);
    const glm::dvec3 lamp(0.5, 2, -0.5);
    expect_ground(
        draw(),
        [&](glm::dvec3 p, glm::dvec3 v) {
            const double d = glm::distance(lamp, p);
            const glm::dvec3 l = (lamp - p) / d;
            const double window = 1 - std::pow(d / 50, 4);
            return 100 / (d * d) * window * l.y * rough_dielectric(0.5, up, v, l);
        },
        0.01);
}

TEST_F(Lighting, SunOnAPlane) {
    builder_.ground({0, 0, 0}, 20);
    const glm::vec3 to_sun = glm::normalize(glm::vec3(1, 2, 0.5f));
    builder_.sun(-to_sun, glm::vec3(10000));
    options_.render.ambient = 0;
    expect_ground(
        draw(),
        [&](glm::dvec3, glm::dvec3 v) {
            return 10000 * to_sun.y * rough_dielectric(0.5, up, v, glm::dvec3(to_sun));
        },
        0.01);
}

TEST_F(Lighting, RangeWindowEndsTheLamp) {
    builder_.ground({0, 0, 0}, 20);
    builder_.point({0, 1, 0}, glm::vec3(100), 2);
    expect_ground(
        draw(),
        [&](glm::dvec3 p, glm::dvec3 v) {
            const double d = glm::distance(glm::dvec3(0, 1, 0), p);
            const glm::dvec3 l = (glm::dvec3(0, 1, 0) - p) / d;
            const double window = std::max(1 - std::pow(d / 2, 4), 0.0);
            return 100 / (d * d) * window * l.y * rough_dielectric(0.5, up, v, l);
        },
        0.01);
}

TEST_F(Lighting, SpotFollowsTheConeLawAndRadiusClampsTheSquare) {
    builder_.ground({0, 0, 0}, 20);
    Light& spot = builder_.spot({0, 2, 0}, {0, -1, 0}, glm::vec3(100), 50, 0.7f);
    spot.radius = 2.1f;  // farther than the nearest ground
    expect_ground(
        draw(),
        [&](glm::dvec3 p, glm::dvec3 v) {
            const double d = glm::distance(glm::dvec3(0, 2, 0), p);
            const glm::dvec3 l = (glm::dvec3(0, 2, 0) - p) / d;
            const double cone = std::clamp(
                (l.y - std::cos(double{0.7f})) / (std::cos(double{0.35f}) - std::cos(double{0.7f})), 0.0, 1.0);
            const double attenuation = (1 - std::pow(d / 50, 4)) / std::max(d * d, 2.1 * 2.1);
            return 100 * attenuation * cone * cone * l.y * rough_dielectric(0.5, up, v, l);
        },
        0.012);
}

TEST_F(Lighting, LampsAdd) {
    builder_.ground({0, 0, 0}, 20);
    builder_.point({0.5f, 2, 0}, glm::vec3(100), 30);
    const Image one = draw();
    builder_.point({0.5f, 2, 0}, glm::vec3(100), 30);
    const Image two = draw();
    for (int i = 8; i < size.x; i += 16)
        EXPECT_NEAR(two.at(i, i)[0], 2 * one.at(i, i)[0], 0.002f * two.at(i, i)[0]);
}

TEST_F(Lighting, EmissionIsTheRadianceOfTheMaterial) {
    builder_.ground({0, 0, 0}, 20, builder_.material(glm::vec3(0.5f), 1, 0, {120, 60, 30}));
    const Image image = draw();
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(32, 32)[c], glm::vec3(120, 60, 30)[c]);
}

TEST_F(Lighting, ASurfaceWithoutReflectanceIsLambert) {
    const int material = builder_.material(glm::vec3(0.5f), 0.3f);
    builder_.scene.materials[static_cast<std::size_t>(material)].dielectric_f0 = 0;
    builder_.ground({0, 0, 0}, 20, material);
    builder_.point({0, 3, 0}, glm::vec3(100), 50);
    expect_ground(
        draw(),
        [&](glm::dvec3 p, glm::dvec3) {
            const double d = glm::distance(glm::dvec3(0, 3, 0), p);
            return 100 / (d * d) * (1 - std::pow(d / 50, 4)) * (3 / d) * 0.5 / pi;
        },
        0.01);
}

TEST_F(Lighting, AnAbsorbingMediumDimsBothLegs) {
    builder_.ground({0, 0, 0}, 20);
    builder_.point({0, 3, 0}, glm::vec3(100), 50);
    Medium medium;
    medium.sigma_a = glm::vec3(0.2f);
    builder_.scene.media.push_back(medium);
    volumetrics_.settings.filter.kernel = volumetrics::Filter::none;
    for (const bool first_leg : {true, false}) {
        volumetrics_.settings.light.transmittance = first_leg;
        expect_ground(
            draw(),
            [&](glm::dvec3 p, glm::dvec3 v) {
                const double d = glm::distance(glm::dvec3(0, 3, 0), p);
                const glm::dvec3 l = (glm::dvec3(0, 3, 0) - p) / d;
                const double to_eye = glm::distance(glm::dvec3(view_.eye), p);
                const double surface =
                    100 / (d * d) * (1 - std::pow(d / 50, 4)) * l.y * rough_dielectric(0.5, up, v, l);
                return surface * std::exp(-0.2 * (to_eye + (first_leg ? d : 0)));
            },
            0.01);
    }
}

TEST_F(Lighting, TheSkyLightsAPlaneInProportionToTheSun) {
    builder_.ground({0, 0, 0}, 20, builder_.material(glm::vec3(1)));
    builder_.sun({0, -1, -0.3f}, glm::vec3(20000), false);
    const auto sky_alone = [&] {
        options_.render.ambient = 1;
        const Image with = draw();
        options_.render.ambient = 0;
        return with.at(32, 32)[1] - draw().at(32, 32)[1];
    };
    const float once = sky_alone();
    // By day a clear sky gives a horizontal plane 5% to 25% of what the sun gives across its beam.
    EXPECT_GT(static_cast<float>(pi) * once, 0.05f * 20000);
    EXPECT_LT(static_cast<float>(pi) * once, 0.25f * 20000);
    builder_.scene.lights[0].intensity *= 2.0f;
    EXPECT_NEAR(sky_alone(), 2 * once, 0.01f * once);
}

}  // namespace
}  // namespace tyndall
