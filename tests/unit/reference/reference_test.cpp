#include "reference/reference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/world.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::reference {
namespace {

using namespace test;
using Shape = Medium::Shape;

/// 200 nodes of Gauss and Legendre over [a, b], by Newton's method on the polynomial's recurrence.
double gauss_200(const auto& f, double a, double b) {
    constexpr int n = 200;
    double sum = 0;
    for (int i = 1; i <= n; ++i) {
        double x = std::cos(pi * (i - 0.25) / (n + 0.5)), derivative = 0;
        for (int step = 0; step < 50; ++step) {
            double p = 1, before = 0;
            for (int k = 1; k <= n; ++k) {
                const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            derivative = n * (x * p - before) / (x * x - 1);
            x -= p / derivative;
            if (std::abs(p / derivative) < 1e-16) break;
        }
        sum += 2 / ((1 - x * x) * derivative * derivative) * f(0.5 * (a + b) + 0.5 * (b - a) * x);
    }
    return 0.5 * (b - a) * sum;
}

// L = E p sigma_s / sigma_t (1 - exp(-sigma_t d)); a homogeneous medium does not attenuate the sun.
TEST(Reference, SunInAHomogeneousMedium) {
    World w;
    const dvec3 to_sun = glm::normalize(dvec3(0.3, 0.5, 1)), d = glm::normalize(dvec3(0.1, -0.2, -1));
    w.sun(glm::vec3(to_sun));
    w.medium(Shape::global, 0.05f, 0.02f, 0.6f);
    const double sigma_s = 0.05f, sigma_t = sigma_s + double(0.02f), p = phase(0.6f, glm::dot(to_sun, d));
    expect_close(w.trace(dvec3(0), d).scattering, sun_lux * (p * sigma_s / sigma_t), 1e-6);
    w.wall(-20);
    const double distance = 20 / -d.z;
    const Reference::Ray ray = w.trace(dvec3(0), d);
    EXPECT_NEAR(ray.distance, distance, 1e-4);
    expect_close(ray.scattering, sun_lux * (-std::expm1(-sigma_t * distance) * p * sigma_s / sigma_t), 1e-6);
    expect_close(ray.transmittance, dvec3(std::exp(-sigma_t * distance)), 1e-6);
}

// Several suns light the air and a Lambert wall; a dark one does not.
TEST(Reference, SunsAdd) {
    const dvec3 d(0, 0, -1), towards[] = {glm::normalize(dvec3(1, 1, 2)), glm::normalize(dvec3(-1, 3, 1))};
    const double lux[] = {5, 30};
    World w;
    w.sun({0, 1, 0}, glm::vec3(0));
    for (int i = 0; i < 2; ++i) w.sun(glm::vec3(towards[i]), glm::vec3(lux[i]));
    w.medium(Shape::global, 0.05f, 0, 0.3f);
    w.wall(-20);
    w.scene.materials.front().dielectric_f0 = 0;
    w.scene.materials.front().metallic = 0;
    double scattered = 0, reflected = 0;
    for (int i = 0; i < 2; ++i) {
        scattered += lux[i] * phase(0.3f, glm::dot(towards[i], d)) * -std::expm1(-double(0.05f) * 20);
        reflected += lux[i] * towards[i].z / pi;
    }
    Settings settings = World::exact();
    settings.black_surfaces = false;
    const Reference::Ray ray = w.trace(dvec3(0), d, settings);
    expect_close(ray.scattering, dvec3(scattered), 1e-6);
    expect_close(ray.background, dvec3(reflected), 1e-6);
}

// Air by Rayleigh, haze by its own phase function, each in every channel.
TEST(Reference, SunInAirAndHaze) {
    const dvec3 to_sun = glm::normalize(dvec3(0.3, 0.5, 1)), d = glm::normalize(dvec3(0.1, -0.2, -1));
    const double cosine = glm::dot(to_sun, d), air_phase = 3 / (16 * pi) * (1 + cosine * cosine);
    const dvec3 air(0.01f, 0.02f, 0.05f);
    for (const float haze : {0.0f, 0.03f}) {
        World w;
        w.sun(glm::vec3(to_sun));
        Medium& m = w.medium(Shape::global, 0, 0);
        m.sigma_s = glm::vec3(air);
        m.rayleigh = true;
        w.medium(Shape::global, haze, 0.02f, 0.6f);
        w.wall(-20);
        const dvec3 sigma_t = air + double(haze) + double(0.02f);
        const dvec3 share = (1.0 - glm::exp(-sigma_t * (20 / -d.z))) / sigma_t;
        const dvec3 hg = sun_lux * (air * air_phase + haze * phase(0.6f, cosine)) * share;
        expect_close(w.trace(dvec3(0), d).scattering, hg, 1e-6);
        Settings two = World::exact();
        two.phase = {ParticlePhase::Kind::double_henyey_greenstein, -0.5, 0.2};
        const double lobes = 0.8 * phase(0.6f, cosine) + 0.2 * phase(-0.5, cosine);
        expect_close(w.trace(dvec3(0), d, two).scattering, sun_lux * (air * air_phase + haze * lobes) * share,
                     1e-6);
    }
}

TEST(Reference, ColouredAndExtremeExtinction) {
    for (const double scale : {1e-8, 1.0, 1e4}) {
        World w;
        w.sun({0, 1, 0});
        Medium& m = w.medium(Shape::global, 0, 0);
        m.sigma_s = glm::vec3(0.01 * scale, 0.3 * scale, 2 * scale);
        const dvec3 d(0, 0, -1);
        expect_close(w.trace(dvec3(0), d).scattering, sun_lux / (4 * pi), 1e-6);
    }
}

// In t: optical depth from the eye A (1 - x), towards the sun B x, with x the density relative to that at the eye.
TEST(Reference, SunInAHeightMedium) {
    const dvec3 to_sun = glm::normalize(dvec3(1, 0.8, 0.2));
    for (const dvec3 d : {glm::normalize(dvec3(0.5, 1, -1)), glm::normalize(dvec3(1, 0.02, 0)),
                          glm::normalize(dvec3(1, -0.3, -1)), dvec3(0, -1, 0)}) {
        World w;
        w.sun(glm::vec3(to_sun));
        Medium& m = w.medium(Shape::height, 0.1f, 0.05f, 0.4f);
        m.base = 1;
        m.falloff = 5;
        const double sigma_s = 0.1f, sigma_t = sigma_s + double(0.05f);
        const double here = sigma_t * 5 * std::exp(-(3.0 - 1) / 5), A = here / std::abs(d.y), B = here / to_sun.y;
        const double rising = A * std::exp(-A) * std::expm1(A - B) / (A - B), falling = A * std::exp(-B) / (A + B);
        const double p = phase(0.4f, glm::dot(to_sun, d));
        expect_close(w.trace(dvec3(0, 3, 0), d).scattering,
                     sun_lux * (p * sigma_s / sigma_t * (d.y > 0 ? rising : falling)), 1e-6);
        Settings unattenuated = World::exact();
        unattenuated.light_transmittance = false;
        const double open = d.y > 0 ? -std::expm1(-A) : 1;
        expect_close(w.trace(dvec3(0, 3, 0), d, unattenuated).scattering, sun_lux * (p * sigma_s / sigma_t * open),
                     1e-6);
    }
}

TEST(Reference, NoSunFromBelowTheHorizonInAHeightMedium) {
    World w;
    w.sun({1, -0.1f, 0});
    w.medium(Shape::height, 0.1f, 0);
    EXPECT_EQ(w.trace(dvec3(0), glm::normalize(dvec3(1, 1, 0))).scattering, dvec3(0));
}

// With the angle a under which the lamp sees the ray, t = nearest + h tan a, d = h / cos a:
// L = I sigma_s / h int exp(-sigma_t (t + d)) p(-sin a) (1 - (d / range)^4) da over what is in range.
double lamp_in_fog(double sigma_s, double sigma_t, double g, double nearest, double h, double range, double end) {
    const double widest = std::acos(h / range);
    const auto f = [&](double a) {
        const double t = nearest + h * std::tan(a), d = h / std::cos(a);
        return std::exp(-sigma_t * (t + d)) * phase(g, -std::sin(a)) * (1 - std::pow(d / range, 4));
    };
    const double first = std::max(-widest, std::atan(-nearest / h));
    const double last = std::min(widest, std::atan((end - nearest) / h));
    // In two parts, as the window is steep far from the lamp.
    return sigma_s / h * (gauss_200(f, first, 0.5 * (first + last)) + gauss_200(f, 0.5 * (first + last), last));
}

TEST(Reference, PointLampInAHomogeneousMedium) {
    struct Case {
        glm::vec3 lamp;
        float range, sigma_s, sigma_a, g;
    };
    for (const Case& c : {Case{{0, 1, -4}, 30, 0.05f, 0.01f, 0.5f}, Case{{0, 0.05f, -4}, 10, 0.2f, 0, 0},
                          Case{{2, 1, 3}, 20, 0.1f, 0.1f, -0.7f}, Case{{0, 0.5f, -2}, 8, 1, 1, 0.9f}}) {
        World w;
        w.point(c.lamp, c.range);
        w.medium(Shape::global, c.sigma_s, c.sigma_a, c.g);
        const double h = std::hypot(c.lamp.x, c.lamp.y), nearest = -c.lamp.z;
        const double sigma_s = c.sigma_s, sigma_t = sigma_s + double(c.sigma_a);
        expect_close(w.trace(dvec3(0), dvec3(0, 0, -1)).scattering,
                     lamp_candela * lamp_in_fog(sigma_s, sigma_t, c.g, nearest, h, c.range, infinity), 1e-6);
        w.wall(-5);  // behind it all is dark
        w.scene.nodes.back().cast_shadow = false;
        expect_close(w.trace(dvec3(0), dvec3(0, 0, -1)).scattering,
                     lamp_candela * lamp_in_fog(sigma_s, sigma_t, c.g, nearest, h, c.range, 5), 1e-6);
    }
}

// A ray straight through a lamp: 1 / max(u², r²) either side, seen from the eye at 2 m.
TEST(Reference, LampOnTheRayAndAtTheEye) {
    const double sigma = 0.1f, g = 0.3f, r = 0.05f, range = 6;
    for (const double nearest : {2.0, 0.0}) {
        World w;
        w.point({0, 0, float(-nearest)}, float(range)).radius = 0.05f;
        w.medium(Shape::global, 0.1f, 0, 0.3f);
        const auto f = [&](double t) {
            const double u = std::abs(t - nearest);
            return std::exp(-sigma * (t + u)) * phase(g, t < nearest ? 1 : -1) * (1 - std::pow(u / range, 4)) /
                   std::max(u * u, r * r);
        };
        double expected = 0;
        const std::array<double, 6> cuts{0, nearest - r, nearest, nearest + r, nearest + 0.5, nearest + range};
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
            if (cuts[i + 1] > 0)
                expected += tyndall::test::integrate(f, std::max(cuts[i], 0.0), cuts[i + 1], 1e-12);
        expect_close(w.trace(dvec3(0), dvec3(0, 0, -1)).scattering, lamp_candela * (sigma * expected), 1e-6);
    }
}

// KHR_lights_punctual's cone, over the part of the ray that lies in it: found by looking along the ray.
TEST(Reference, SpotLamp) {
    for (const float inner : {0.2f, 0.4999f}) {
        World w;
        Light& spot = w.light(LightType::spot, {1, 2, -5}, {-0.2f, -1, 0.3f}, {30, 20, 10});
        spot.range = 12;
        spot.inner_cone = inner;
        spot.outer_cone = 0.5f;
        w.medium(Shape::global, 0.1f, 0.02f, 0.5f);
        const dvec3 axis = glm::normalize(dvec3(-0.2f, -1, 0.3f)), lamp(1, 2, -5), d(0, 0, -1);
        const double scale = 1 / std::max(0.001 * (1 - std::cos(0.5)), std::cos(double(inner)) - std::cos(0.5));
        const double sigma_t = double(0.1f) + double(0.02f);
        const auto f = [&](double t) {
            const dvec3 offset = t * d - lamp;
            const double distance = glm::length(offset);
            const double cone = std::clamp((glm::dot(offset, axis) / distance - std::cos(0.5)) * scale, 0.0, 1.0);
            return std::exp(-sigma_t * (t + distance)) * phase(0.5, glm::dot(-offset / distance, d)) * cone * cone *
                   std::max(0.0, 1 - std::pow(distance / 12, 4)) / (distance * distance);
        };
        const double expected = double(0.1f) * tyndall::test::integrate_panels(f, 0, 20, 20000);
        EXPECT_GT(expected, 1e-5);
        expect_close(w.trace(dvec3(0), d).scattering, lamp_candela * expected, inner < 0.3f ? 1e-6 : 2e-5);
        // Away from the cone, and beyond the range.
        EXPECT_EQ(w.trace(dvec3(1, 2.5, 0), d).scattering, dvec3(0));
        EXPECT_EQ(w.trace(dvec3(0, -15, 0), d).scattering, dvec3(0));
    }
}

TEST(Reference, EmissionAndAmbient) {
    World w;
    w.medium(Shape::global, 0, 0.25f).emission = {1, 2, 4};
    w.wall(-8);
    expect_close(w.trace(dvec3(0), dvec3(0, 0, -1)).scattering, dvec3(1, 2, 4) * (-std::expm1(-2.0) / 0.25), 1e-6);
    World clear;
    Medium& m = clear.medium(Shape::sphere, 0, 0);
    m.emission = {1, 2, 4};
    m.half_extent = glm::vec3(3);
    expect_close(clear.trace(dvec3(0, 0, 9), dvec3(0, 0, -1)).scattering, 6.0 * dvec3(1, 2, 4), 1e-6);
    EXPECT_EQ(clear.trace(dvec3(0, 0, 9), dvec3(0, 0, -1)).transmittance, dvec3(1));
}

// A lamp 3 m above the middle of a box 2 m wide: the ray's light enters through the top, straight above (2/3) t.
TEST(Reference, LocalMediaAttenuateLight) {
    World w;
    w.point({0, 3, 0}, 1e4f);
    Medium& m = w.medium(Shape::box, 0.4f, 0.2f);
    m.half_extent = {1, 1, 4};
    const double sigma_s = 0.4f, sigma_t = sigma_s + double(0.2f);
    const auto f = [&](double t) {
        const double x = t - 4, d2 = x * x + 9;
        return std::exp(-sigma_t * (x + 1 + std::sqrt(d2) / 3)) / d2;
    };
    expect_close(w.trace(dvec3(-4, 0, 0), dvec3(1, 0, 0)).scattering,
                 lamp_candela * (sigma_s / (4 * pi) * tyndall::test::integrate(f, 3, 5, 1e-12)), 1e-6);
    // The sun from above through the same box, 1 m thick there.
    World day;
    day.sun({0, 1, 0});
    day.scene.media = w.scene.media;
    expect_close(day.trace(dvec3(-4, 0, 0), dvec3(1, 0, 0)).scattering,
                 sun_lux * (sigma_s / sigma_t / (4 * pi) * -std::expm1(-2 * sigma_t) * std::exp(-sigma_t)), 1e-6);
}

TEST(Reference, LightsAddUpAndScale) {
    const glm::vec3 spots[] = {{0, 1, -3}, {1, -1, -6}, {-2, 0.3f, -1}};
    const auto build = [&](int mask, float factor) {
        World w;
        if (mask & 1) w.sun({0.2f, 1, 0.1f}, factor * glm::vec3(sun_lux));
        for (int i = 0; i < 3; ++i)
            if (mask & (2 << i)) w.point(spots[i], 10, factor * glm::vec3(lamp_candela));
        w.medium(Shape::height, 0.05f, 0.01f, 0.3f);
        Medium& m = w.medium(Shape::sphere, 0.2f, 0);
        m.center = {0, 0, -4};
        m.half_extent = glm::vec3(2);
        m.softness = 0.5f;
        return w.trace(dvec3(0), dvec3(0, 0, -1)).scattering;
    };
    expect_close(build(15, 1), build(1, 1) + build(2, 1) + build(4, 1) + build(8, 1), 1e-7);
    expect_close(build(15, 1000), 1000.0 * build(15, 1), 1e-7);
}

// A plate 2 m wide above the ray: below it, a slanted shadow.
TEST(Reference, ShadowsAreExact) {
    World w;
    const dvec3 to_sun = glm::normalize(dvec3(1, 1, 0));
    w.sun(glm::vec3(to_sun));
    w.medium(Shape::global, 0.1f, 0);
    w.quad(w.mesh(), {3, 2, -5}, {2, 0, 0}, {0, 0, 10});
    // Sun rays at 45 degrees: the plate over x in 3..5 at y = 2 shades 1..3 at y = 0.
    const double sigma = 0.1f;
    const auto integral = [&](double a, double b) { return std::exp(-sigma * a) - std::exp(-sigma * b); };
    const double p = 1 / (4 * pi);
    expect_close(w.trace(dvec3(0), dvec3(1, 0, 0)).scattering,
                 sun_lux * (p * (integral(0, 1) + integral(3, infinity))), 1e-6);
    Settings open = World::exact();
    open.shadows = false;
    expect_close(w.trace(dvec3(0), dvec3(1, 0, 0), open).scattering, sun_lux * p, 1e-6);
    w.scene.lights[0].shadow = false;
    expect_close(w.trace(dvec3(0), dvec3(1, 0, 0)).scattering, sun_lux * p, 1e-6);
}

TEST(Reference, ErrorEstimateHolds) {
    World w;
    w.sun({0.5f, 1, 0.2f});
    w.point({0.3f, 0.4f, -4}, 8);
    Medium& m = w.medium(Shape::box, 0.3f, 0.05f, 0.4f);
    m.half_extent = {4, 1.5f, 4};
    m.center = {0, 0, -5};
    m.softness = 0.4f;
    m.noise_scale = 1.1f;
    m.noise_amount = 0.9f;
    for (const double slope : {0.0, 0.15, -0.2}) {
        const dvec3 d = glm::normalize(dvec3(slope, 0.5 * slope, -1));
        const dvec3 best =
            w.trace(dvec3(0), d, {.ambient = 0, .black_surfaces = true, .tolerance = 1e-5}).scattering;
        for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
            const Reference::Ray ray =
                w.trace(dvec3(0), d, {.ambient = 0, .black_surfaces = true, .tolerance = tolerance});
            EXPECT_LE(std::abs(ray.scattering.x - best.x), ray.error + 1e-5 * best.x)
                << slope << " " << tolerance << " of " << best.x;
            EXPECT_LE(ray.error, tolerance * best.x);
        }
    }
}

TEST(Reference, LampsTooFaintToMatterAreLeftOutAndCountAsError) {
    World w;
    w.point({0, 1, -3}, 10);
    w.medium(Shape::global, 0.05f, 0);
    const Settings settings{.ambient = 0, .black_surfaces = true, .tolerance = 1e-3};
    const dvec3 alone = w.trace(dvec3(0), dvec3(0, 0, -1), settings).scattering;
    for (int i = 0; i < 20; ++i) w.point({0, 3, -1}, 10, glm::vec3(1e-5f));
    const Reference::Ray ray = w.trace(dvec3(0), dvec3(0, 0, -1), settings);
    EXPECT_EQ(ray.scattering, alone);
    const dvec3 exact = w.trace(dvec3(0), dvec3(0, 0, -1)).scattering;
    EXPECT_GT(exact.x, alone.x);
    EXPECT_LE(std::abs(exact.x - ray.scattering.x), ray.error);
}

TEST(Reference, PictureDoesNotDependOnThreads) {
    World w;
    w.sun({0.2f, 1, 0.4f});
    w.point({0, 1, -3}, 10);
    w.medium(Shape::global, 0.05f, 0.01f, 0.5f);
    w.box(w.mesh(), {-1, -1, -6}, {0.5f, 1.5f, -4});
    const Reference reference(w.scene, {});
    const View view = look_at({0, 0, 0}, {0, 0, -1}, 1, 0.1f, 2);
    int steps = 0;
    const Picture one = render(reference, view, {16, 8}, 2, 1, [&](int done, int all) {
        EXPECT_EQ(done, ++steps);
        EXPECT_EQ(all, 8);
    });
    const Picture three = render(reference, view, {16, 8}, 2, 3);
    EXPECT_EQ(one.color.pixels, three.color.pixels);
    EXPECT_EQ(one.scattering.pixels, three.scattering.pixels);
    EXPECT_EQ(one.transmittance.pixels, three.transmittance.pixels);
    EXPECT_EQ(one.error.pixels, three.error.pixels);
    EXPECT_EQ(one.depth.pixels, three.depth.pixels);
    EXPECT_EQ(steps, 8);
}

TEST(Reference, PixelsAreWhereTheViewPutsThem) {
    World w;
    w.medium(Shape::global, 0, 0.1f);
    w.wall(-10);
    // A plate nearer in the upper left quarter.
    w.quad(w.mesh(), {-20, 0, -5}, {20, 0, 0}, {0, 20, 0});
    const View view = look_at({0, 0, 0}, {0, 0, -1}, 1, 0.1f, 1);
    const Picture picture = render(Reference(w.scene, World::exact()), view, {4, 4}, 1, 2);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const double depth = x < 2 && y < 2 ? 5 : 10;
            EXPECT_NEAR(*picture.depth.at(x, y), depth, 1e-4);
            const double sx = std::tan(0.5) * (x - 1.5) / 2, sy = std::tan(0.5) * (y - 1.5) / 2;
            EXPECT_NEAR(picture.transmittance.at(x, y)[0],
                        std::exp(-0.1 * depth * std::sqrt(1 + sx * sx + sy * sy)), 1e-6);
        }
}

TEST(Reference, ThingsBeforeTheNearPlaneAreNotSeen) {
    World w;
    w.wall(-1);
    w.wall(-3);
    const Reference reference(w.scene, World::exact());
    EXPECT_NEAR(reference.trace(dvec3(0), dvec3(0, 0, -1), 0.5).distance, 1, 1e-6);
    EXPECT_NEAR(reference.trace(dvec3(0), dvec3(0, 0, -1), 2).distance, 3, 1e-6);
    EXPECT_EQ(reference.trace(dvec3(0), dvec3(0, 0, 1), 0).distance, infinity);
}

}  // namespace
}  // namespace tyndall::reference
