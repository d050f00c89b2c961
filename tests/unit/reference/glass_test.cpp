#include "support/glass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::reference {
namespace {

using namespace test;

/// A white Lambert wall at z = -20 and a light before it: from (0, 0, 0), or along -Z.
class GlassBeforeAWall : public testing::TestWithParam<LightType> {
  protected:
    GlassBeforeAWall() {
        w.wall(-20);
        w.scene.materials[0].dielectric_f0 = 0;
        w.scene.materials[0].metallic = 0;
        if (GetParam() == LightType::sun)
            w.sun({0, 0, 1});
        else
            w.light(GetParam(), {0, 0, 0}, {0, 0, -1}, glm::vec3(lamp_candela)).range = 50;
    }
    /// Across the light's way to what is |x|, |y| <= 2 on the wall.
    void square(Mesh& mesh, float z) const {
        const float half = GetParam() == LightType::sun ? 2 : -z / 10;
        World::quad(mesh, {-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0});
    }
    /// Irradiance / pi, times what is left of the light.
    void expect_wall(double x, double y, const dvec3& filter) const {
        dvec3 expected = sun_lux / pi;
        if (GetParam() != LightType::sun) {
            const double d = std::sqrt(x * x + y * y + 400), cosine = 20 / d;
            expected = lamp_candela * ((1 - std::pow(d / 50, 4)) / (d * d) * cosine / pi);
            const double edge = std::cos(double{Light{}.outer_cone});
            if (GetParam() == LightType::spot) expected *= std::pow((cosine - edge) / (1 - edge), 2);
        }
        Settings settings = World::exact();
        settings.black_surfaces = false;
        expect_close(w.trace({x, y, -19.5}, {0, 0, -1}, settings).background, expected * filter, 1e-6);
    }
    World w;
};
INSTANTIATE_TEST_SUITE_P(Lights, GlassBeforeAWall,
                         testing::Values(LightType::sun, LightType::point, LightType::spot));

TEST_P(GlassBeforeAWall, TintsWhatLiesBehindIt) {
    square(red.mesh(w), -10);
    // The last three: on the edge between its triangles, and on the way through its middle.
    for (const dvec2 p : {dvec2(0.3, 1.9), dvec2(-1.99, 0.1), dvec2(1, 1), dvec2(-0.5, -0.5), dvec2(0, 0)})
        expect_wall(p.x, p.y, red.filter());
    for (const dvec2 p : {dvec2(2.01, 1), dvec2(0.1, -2.01), dvec2(-7, 3)}) expect_wall(p.x, p.y, dvec3(1));
}

TEST_P(GlassBeforeAWall, PanesMultiplyAndOpaqueStaysOpaque) {
    square(red.mesh(w), -10);
    square(blue.mesh(w), -15);
    square(grey.mesh(w), -5);
    expect_wall(0.3, 1, red.filter() * blue.filter() * grey.filter());
    for (const float z : {-4.0f, -12.0f, -18.0f}) {
        World::quad(w.mesh(), {-10, -10, z}, {20, 0, 0}, {0, 20, 0});
        expect_wall(0.3, 1, dvec3(0));
        w.scene.nodes.pop_back();
    }
}

TEST_P(GlassBeforeAWall, BehindTheWallOrWithoutShadowItDoesNothing) {
    square(red.mesh(w), -25);
    expect_wall(0.3, 1, dvec3(1));
    if (GetParam() != LightType::sun) {  // behind the lamp
        World::quad(red.mesh(w), {-9, -9, 2}, {18, 0, 0}, {0, 18, 0});
        expect_wall(0.3, 1, dvec3(1));
    }
    square(red.mesh(w), -10);
    w.scene.nodes.back().cast_shadow = false;
    expect_wall(0.3, 1, dvec3(1));
    w.scene.nodes.back().cast_shadow = true;
    expect_wall(0.3, 1, red.filter());
    w.scene.lights[0].shadow = false;
    expect_wall(0.3, 1, dvec3(1));
}

TEST_P(GlassBeforeAWall, ClearAndBlack) {
    square(clear.mesh(w), -10);
    expect_wall(0.3, 1, dvec3(1));
    square(black.mesh(w), -5);
    expect_wall(0.3, 1, dvec3(0));
}

TEST_P(GlassBeforeAWall, MirroredNodes) {
    // Only x > 0 of what it shines on; mirrored, x < 0.
    const float half = GetParam() == LightType::sun ? 2 : 1;
    World::quad(red.mesh(w), {0, -half, -10}, {half, 0, 0}, {0, 2 * half, 0});
    expect_wall(1, 1, red.filter());
    expect_wall(-1, 1, dvec3(1));
    w.scene.nodes.back().world[0].x = -1;
    expect_wall(-1, 1, red.filter());
    expect_wall(1, 1, dvec3(1));
}

TEST_P(GlassBeforeAWall, PicturesAndVertexColours) {
    Mesh& mesh = red.mesh(w);
    square(mesh, -10);
    for (Vertex& v : mesh.vertices) v.color = glm::vec4(1, 0.5f, 1, 1 - v.uv.y);
    // sRGB 188 is 0.50289; nearest texels: left and right.
    w.scene.pictures.push_back({"p", {2, 1}, {188, 255, 0, 255, 255, 188, 255, 51}, {.nearest = true}});
    w.scene.materials.back().base_color_picture = 0;
    const double texel = 0.502886;
    for (const double y : {-1.0, 0.5}) {
        const double fade = 0.5 - y / 4, left = 0.5 * fade, right = 0.2 * left, t = 0.75;
        expect_wall(-1, y, (1 - left) + left * t * dvec3(texel, 0.5 * 0.5, 0));
        expect_wall(1, y, (1 - right) + right * t * dvec3(1, 0.5 * 0.5 * texel, 0.25));
    }
}

/// A ray along x in fog, and glass of 2 m above it at y = 2, from x = 3 to 5.
struct Shaft : World {
    static constexpr double sigma = 0.1f;
    Shaft() { medium(Medium::Shape::global, 0.1f, 0); }
    explicit Shaft(const Glass& glass) : Shaft() { pane(glass); }
    void pane(const Glass& glass, float y = 2) { quad(glass.mesh(*this), {3, y, -5}, {2, 0, 0}, {0, 0, 10}); }

    /// Of fog that is lit with `filter` from a to b, and lamps' light on the way to what is seen.
    [[nodiscard]] static dvec3 lit(double a, double b, const dvec3& filter = dvec3(1)) {
        return sun_lux * filter * ((std::exp(-sigma * a) - std::exp(-sigma * b)) / (4 * pi));
    }
};

TEST(GlassInAir, TintsTheSunsShaft) {
    Shaft w(red);
    w.sun({0, 1, 0});
    const dvec3 f = red.filter();
    const auto along_x = [&] { return w.trace(dvec3(0), {1, 0, 0}).scattering; };
    expect_close(along_x(), w.lit(0, 3) + w.lit(3, 5, f) + w.lit(5, infinity), 1e-6);
    // Through the shaft and the pane itself at x = 4: clear behind it.
    const double s = std::sqrt(2);
    expect_close(w.trace({2, 0, 0}, glm::normalize(dvec3(1, 1, 0))).scattering,
                 w.lit(0, s) + w.lit(s, 2 * s, f) + w.lit(2 * s, infinity), 1e-6);
    // Along the sun, both ways.
    expect_close(w.trace({4, 0, 0}, {0, 1, 0}).scattering, w.lit(0, 2, f) + w.lit(2, infinity), 1e-6);
    expect_close(w.trace({4, 5, 0}, {0, -1, 0}).scattering, w.lit(0, 3) + w.lit(3, infinity, f), 1e-6);
    // Before the pane.
    expect_close(w.trace({0, 3, 0}, {1, 0, 0}).scattering, w.lit(0, infinity), 1e-6);
    // A second pane, and a plate over half of both.
    World::quad(blue.mesh(w), {4, 3, -5}, {4, 0, 0}, {0, 0, 10});
    expect_close(along_x(),
                 w.lit(0, 3) + w.lit(3, 4, f) + w.lit(4, 5, f * blue.filter()) + w.lit(5, 8, blue.filter()) +
                     w.lit(8, infinity),
                 1e-6);
    World::quad(w.mesh(), {2, 2.5f, -5}, {1.5, 0, 0}, {0, 0, 10});
    World::quad(w.mesh(), {4.5, 1, -5}, {1, 0, 0}, {0, 0, 10});
    expect_close(along_x(),
                 w.lit(0, 2) + w.lit(3.5, 4, f) + w.lit(4, 4.5, f * blue.filter()) + w.lit(5.5, 8, blue.filter()) +
                     w.lit(8, infinity),
                 1e-6);
}

TEST(GlassInAir, ClearIsNothingAndBlackIsOpaque) {
    Shaft none, opaque, of_clear(clear), of_black(black);
    World::quad(opaque.mesh(), {3, 2, -5}, {2, 0, 0}, {0, 0, 10});
    for (World* w : {&none, &opaque, &of_clear, &of_black}) {
        w->sun({0.3f, 1, 0.2f});
        w->point({4, 4, 0.1f}, 30);
    }
    for (const dvec3 d : {dvec3(1, 0, 0), glm::normalize(dvec3(1, 0.3, 0)), glm::normalize(dvec3(1, -0.1, 0.2))}) {
        expect_close(of_clear.trace(dvec3(0), d).scattering, none.trace(dvec3(0), d).scattering, 1e-7);
        expect_close(of_black.trace(dvec3(0), d).scattering, opaque.trace(dvec3(0), d).scattering, 1e-7);
    }
}

TEST(GlassInAir, WithoutShadowsItIsClear) {
    Shaft w(red);
    w.sun({0, 1, 0});
    Settings settings = World::exact();
    settings.shadows = false;
    expect_close(w.trace(dvec3(0), {1, 0, 0}, settings).scattering, w.lit(0, infinity), 1e-6);
    w.scene.lights[0].shadow = false;
    expect_close(w.trace(dvec3(0), {1, 0, 0}).scattering, w.lit(0, infinity), 1e-6);
}

// A lamp at twice the height of the pane tints twice its width: from x = 2 to 6.
TEST(GlassInAir, TintsLamps) {
    for (const LightType type : {LightType::point, LightType::spot}) {
        Shaft w(red);
        Light& lamp = w.light(type, {4, 4, 0}, {0, -1, 0}, glm::vec3(lamp_candela));
        lamp.range = 20;
        const double edge = std::cos(double{lamp.outer_cone});
        // At (x, y, 0), t metres from the eye.
        const auto light = [&](double x, double y, double t) {
            const double d2 = (x - 4) * (x - 4) + (y - 4) * (y - 4), d = std::sqrt(d2), cosine = (4 - y) / d;
            const double cone = std::pow(std::clamp((cosine - edge) / (1 - edge), 0.0, 1.0), 2);
            return std::exp(-w.sigma * (t + d)) * std::max(1 - std::pow(d / 20, 4), 0.0) / d2 *
                   (type == LightType::spot ? cone : 1) * w.sigma / (4 * pi);
        };
        const auto part = [&](dvec3 origin, dvec3 d, double a, double b) {
            const auto f = [&](double t) { return light(origin.x + t * d.x, origin.y + t * d.y, t); };
            return tyndall::test::integrate_panels(f, a, b, 4000);
        };
        const auto expect_tinted = [&](dvec3 origin, dvec3 d, double a, double b) {
            const dvec3 expected = lamp_candela * (part(origin, d, 0, a) + red.filter() * part(origin, d, a, b) +
                                                   part(origin, d, b, 40));
            expect_close(w.trace(origin, d).scattering, expected, 1e-5);
        };
        expect_tinted(dvec3(0), {1, 0, 0}, 2, 6);
        expect_tinted({9, -1, 0}, {-1, 0, 0}, 2.5, 7.5);
        // Into the shaft at (2.5, 1), and out of it through the pane at (3.5, 2).
        expect_tinted({1.5, 0, 0}, glm::normalize(dvec3(1, 1, 0)), std::sqrt(2), 2 * std::sqrt(2));
        expect_tinted({4.5, 0, 0}, {0, 1, 0}, 0, 2);
    }
}

// Sun from above: of a picture's columns under each other, by u = (x - 3) / 2.
TEST(GlassInAir, ShowsThePicture) {
    const auto scene = [](Sampling sampling) {
        Shaft w({glm::vec4(1), 1});
        w.sun({0, 1, 0});
        w.scene.pictures.push_back({"p", {2, 1}, {255, 0, 0, 255, 0, 0, 255, 255}, sampling});
        w.scene.materials.back().base_color_picture = 0;
        return w;
    };
    const dvec3 left(1, 0, 0), right(0, 0, 1);
    Shaft w = scene({.nearest = true});
    expect_close(w.trace(dvec3(0), {1, 0, 0}).scattering,
                 w.lit(0, 3) + w.lit(3, 4, left) + w.lit(4, 5, right) + w.lit(5, infinity), 1e-6);
    // Bilinear, from texel centre to texel centre: int x exp(-s x) over 1 m from a is exp(-s a) (1 - (1 + s)
    // exp(-s)) / s².
    w = scene({.u = Wrap::clamp});
    const double s = w.sigma, rising = (1 - (1 + s) * std::exp(-s)) / s * std::exp(-s * 3.5) / (4 * pi);
    expect_close(w.trace(dvec3(0), {1, 0, 0}).scattering,
                 w.lit(0, 3) + w.lit(3, 4.5, left) - sun_lux * left * rising + sun_lux * right * rising +
                     w.lit(4.5, 5, right) + w.lit(5, infinity),
                 1e-6);
}

// Thin leads between many texels of glass: 64 of 2 texels in the place of one pane of 4 columns.
TEST(GlassInAir, ShowsPicturesOfManyTexels) {
    Shaft w({glm::vec4(1), 1});
    w.sun({0, 1, 0});
    tyndall::Picture picture{"p", {256, 1}, {}, {.nearest = true}};
    dvec3 expected = w.lit(0, 3) + w.lit(5, infinity);
    for (int i = 0; i < 256; ++i) {
        const bool lead = i % 16 == 5;
        const std::uint8_t v = lead ? 0 : 255;
        picture.rgba.insert(picture.rgba.end(), {v, v, v, 255});
        if (!lead) expected += w.lit(3 + i / 128.0, 3 + (i + 1) / 128.0);
    }
    w.scene.pictures.push_back(picture);
    w.scene.materials.back().base_color_picture = 0;
    Settings settings = World::exact();
    settings.tolerance = 1e-4;
    expect_close(w.trace(dvec3(0), {1, 0, 0}, settings).scattering, expected, 1e-3);
}

}  // namespace
}  // namespace tyndall::reference
