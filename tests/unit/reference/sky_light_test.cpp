#include "reference/sky_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "shaders/lib/glm_subset.h"
#include "support/glass.h"
#include "tests/unit/shader_lib/quadrature.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/sky_background.glsl"
TYNDALL_GLSL_END

namespace tyndall::reference {
namespace {

using namespace test;
using Shape = Medium::Shape;

const dvec3 to_sun = glm::normalize(dvec3(0.4, 0.5, -0.6));

/// The clear sky of that sun with 20000 lux, asked of the model itself.
dvec3 clear_sky(dvec3 d) {
    return dvec3(glsl::sky_radiance(glm::vec3(d), glm::vec3(to_sun), 20000));
}
const SkyTable& sky_at_day() {
    static const SkyTable table(clear_sky);
    return table;
}
const dvec3 even_radiance(300, 200, 100);
const SkyTable& even_sky() {
    static const SkyTable table([](dvec3) { return even_radiance; });
    return table;
}

/// A world and its sky's light, with the factor 1.
struct SkyWorld : World {
    InScattering::Result along(const SkyTable& sky, dvec3 origin, dvec3 direction, double end = infinity,
                               int samples = 4096) const {
        Settings settings = exact();
        settings.ambient = 1;
        settings.sky_samples = samples;
        const Geometry geometry(scene, true);
        const Media media(scene.media);
        const Lighting lighting;
        const InScattering scattering(geometry, media, lighting, settings);
        return SkyLight(sky, geometry, scattering, settings)
            .along(MediaRay(media, origin, direction, end, 1e-8), origin, direction);
    }
    /// Of what a ray along -Y meets.
    dvec3 reflected_from_above(const SkyTable& sky, dvec3 origin, int samples = 4096) const {
        Settings settings = exact();
        settings.ambient = 1;
        settings.sky_samples = samples;
        const Geometry geometry(scene, true);
        const Media media(scene.media);
        const Lighting lighting;
        const InScattering scattering(geometry, media, lighting, settings);
        const dvec3 down(0, -1, 0);
        const auto hit = geometry.closest_hit(origin, down, 0);
        if (!hit) return dvec3(-1);
        return SkyLight(sky, geometry, scattering, settings)
            .reflected(surface_at(scene, geometry, *hit, origin, down), -down);
    }
    /// A room about the origin, 4 m wide and high and 6 m long (Z), with a window in the middle of its wall at +Z,
    /// or of its ceiling, of these half sizes; 0: closed.
    static constexpr float x = 2, y = 2, z = 3;
    void room(glm::vec2 window, glm::vec2 skylight) {
        Mesh& m = mesh();
        quad(m, {-x, -y, -z}, {2 * x, 0, 0}, {0, 0, 2 * z});
        quad(m, {-x, -y, -z}, {2 * x, 0, 0}, {0, 2 * y, 0});
        for (const float side : {-x, x}) quad(m, {side, -y, -z}, {0, 2 * y, 0}, {0, 0, 2 * z});
        framed(m, {0, 0, z}, {x, 0, 0}, {0, y, 0}, window);
        framed(m, {0, y, 0}, {x, 0, 0}, {0, 0, z}, skylight);
    }

  private:
    /// A rectangle center ± u ± v with a hole of these half sizes.
    static void framed(Mesh& m, glm::vec3 center, glm::vec3 u, glm::vec3 v, glm::vec2 hole) {
        const glm::vec3 a = hole.x * glm::normalize(u), b = hole.y * glm::normalize(v);
        quad(m, center - u - v, 2.0f * u, v - b);
        quad(m, center - u + b, 2.0f * u, v - b);
        quad(m, center - u - b, u - a, 2.0f * b);
        quad(m, center + a - b, u - a, 2.0f * b);
    }
};

/// Mean of f over the sphere, on a lattice of its own.
template <class F>
dvec3 sphere_mean(F f) {
    constexpr int n = 40000;
    dvec3 sum(0);
    for (int i = 0; i < n; ++i) {
        const double y = 1 - (2 * i + 1.0) / n, azimuth = i * pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - y * y);
        sum += f(dvec3(r * std::cos(azimuth), y, r * std::sin(azimuth)));
    }
    return sum / static_cast<double>(n);
}

/// The integral of a sky times Henyey and Greenstein's function about `axis`, in `rings` rings of equal shares of
/// that function.
template <class F>
dvec3 convolved(F sky, double g, dvec3 axis, int rings) {
    const dvec3 first = glm::normalize(glm::cross(axis, dvec3(0.3, 0.9, 0.1))), second = glm::cross(axis, first);
    dvec3 sum(0);
    for (int i = 0; i < rings; ++i) {
        const double share = (i + 0.5) / rings;  // Witt 1977
        const double root = (1 - g * g) / (1 - g + 2 * g * share);
        const double cosine = g == 0 ? 2 * share - 1 : (1 + g * g - root * root) / (2 * g);
        const double sine = std::sqrt(1 - cosine * cosine), turn = std::fmod(i * 0.6180339887498949, 1.0);
        for (int k = 0; k < rings; ++k) {
            const double azimuth = 2 * pi * (k + turn) / rings;
            sum += sky(cosine * axis + sine * (std::cos(azimuth) * first + std::sin(azimuth) * second));
        }
    }
    return sum / std::pow(rings, 2);
}

TEST(SkySampler, WeightsIntegrateTheTableTimesAnything) {
    const SkySampler sampler(sky_at_day(), [](dvec3 d) { return 1.1 + d.x; });
    dvec3 sum(0), moment(0);
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
        const auto [direction, weight] = sampler.at((i + 0.5) / n, std::fmod(i * 0.6180339887498949, 1.0));
        EXPECT_NEAR(glm::length(direction), 1, 1e-12);
        sum += weight / double{n};
        moment += weight * direction.z / double{n};
    }
    expect_close(sum, 4 * pi * sphere_mean(clear_sky), 2e-3);
    expect_close(moment, 4 * pi * sphere_mean([](dvec3 d) { return clear_sky(d) * d.z; }), 3e-3);
}

TEST(SkyLight, AnOpenEvenSkyIsItsRadianceWhateverThePhaseFunction) {
    for (const float g : {-0.8f, 0.0f, 0.5f, 0.9f}) {
        SkyWorld w;
        w.medium(Shape::global, 0.05f, 0.02f, g);
        const double albedo = double{0.05f} / (double{0.05f} + double{0.02f});
        expect_close(w.along(even_sky(), dvec3(0), glm::normalize(dvec3(1, 0.2, -0.4)), infinity, 1 << 16).radiance,
                     albedo * even_radiance, 1e-3);
    }
}

// Towards the sun, away from it, along the horizon and down. The table that is drawn from differs from the model by
// up to 1.3e-3 (towards the sun).
TEST(SkyLight, AnOpenSkyIsConvolvedWithThePhaseFunction) {
    const auto table = [](dvec3 d) { return sky_at_day().at(d); };
    for (const dvec3 d : {to_sun, -to_sun, dvec3(1, 0, 0), glm::normalize(dvec3(0.2, -1, 0.3))})
        for (const float g : {-0.8f, 0.0f, 0.5f, 0.9f}) {
            SkyWorld w;
            w.medium(Shape::global, 0.05f, 0, g);
            SCOPED_TRACE(testing::Message() << "g " << g << " towards " << d.x << ' ' << d.y << ' ' << d.z);
            const dvec3 found = w.along(sky_at_day(), dvec3(0), d, infinity, 1 << 16).radiance;
            expect_close(found, convolved(table, double{g}, d, 600), 1e-3);
            if (d != dvec3(1, 0, 0)) expect_close(found, convolved(clear_sky, double{g}, d, 150), 4e-3);
        }
}

// Isotropic, from below, up: the upper half of the sky through a flat layer is E2 of its depth over two.
TEST(SkyLight, AHeightMediumDimsTheSky) {
    SkyWorld w;
    Medium& m = w.medium(Shape::height, 0.1f, 0.05f);
    m.base = 0;
    m.falloff = 8;
    const double sigma_s = 0.1f, sigma_t = sigma_s + double{0.05f}, below = sigma_t * 8;
    const auto f = [&](double depth) {  // above the point
        const double e2 = depth > 0 ? std::exp(-depth) + depth * std::expint(-depth) : 1;
        return std::exp(depth - below) * 0.5 * e2;
    };
    const double expected = sigma_s / sigma_t * tyndall::test::integrate(f, 0, below, 1e-10);
    expect_close(w.along(even_sky(), dvec3(0), {0, 1, 0}, infinity, 1 << 16).radiance, expected * even_radiance,
                 2e-3);
}

// Along it any phase function has half, and away from it
// (1 - g²) / (2 g) (1 / (1 - g) - 1 / sqrt(1 + g²)).
TEST(SkyLight, AWallTakesHalfOfTheSky) {
    for (const float g : {-0.8f, 0.0f, 0.5f, 0.9f}) {
        SkyWorld w;
        w.medium(Shape::global, 0.05f, 0, g);
        w.quad(w.mesh(), {-1e5f, -1e5f, -1}, {2e5f, 0, 0}, {0, 2e5f, 0});
        const double G = g,
                     forward = g == 0 ? 0.5 : (1 - G * G) / (2 * G) * (1 / (1 - G) - 1 / std::sqrt(1 + G * G));
        SCOPED_TRACE(g);
        expect_close(w.along(even_sky(), dvec3(0), {1, 0, 0}, infinity, 1 << 16).radiance, 0.5 * even_radiance,
                     3e-3);
        expect_close(w.along(even_sky(), dvec3(0), {0, 0, 1}, infinity, 1 << 16).radiance, forward * even_radiance,
                     3e-3);
    }
}

TEST(SkyLight, GlassTintsTheSky) {
    SkyWorld w;
    w.medium(Shape::global, 0.05f, 0);
    w.quad(red.mesh(w), {-1e5f, -1e5f, -1}, {2e5f, 0, 0}, {0, 2e5f, 0});
    expect_close(w.along(even_sky(), dvec3(0), {1, 0, 0}).radiance, 0.5 * (red.filter() + 1.0) * even_radiance,
                 5e-3);
}

TEST(SkyLight, NoneInAClosedRoom) {
    SkyWorld w;
    w.medium(Shape::global, 0.05f, 0, 0.5f);
    w.room({0, 0}, {0, 0});
    const auto [radiance, error] = w.along(sky_at_day(), {0.3, 0.1, 1}, {0, 0, -1}, 4);
    EXPECT_EQ(radiance, dvec3(0));
    EXPECT_EQ(error, 0);
    EXPECT_EQ(w.reflected_from_above(sky_at_day(), {0.3, 0.1, 1}), dvec3(0));
}

/// 1 m by 0.6 m at the end of the room: its solid angle where the ray along the axis is, over 4 pi, and so on.
struct RoomWithWindow : SkyWorld {
    static constexpr glm::vec2 window{0.5f, 0.3f};
    static constexpr double sigma = 0.05f;
    RoomWithWindow() {
        medium(Shape::global, float(sigma), 0);
        room(window, {0, 0});
    }
    /// From the far wall, `aside` of the axis, towards the window's wall.
    [[nodiscard]] InScattering::Result from_far_wall(dvec2 aside, int samples) const {
        return along(even_sky(), {aside, -z}, {0, 0, 1}, 2 * z, samples);
    }
    [[nodiscard]] static double expected(dvec2 aside) {
        // Of a rectangle with a corner at the foot of the point, signed.
        const auto corner = [](double a, double b, double d) {
            return std::atan(a * b / (d * std::sqrt(a * a + b * b + d * d)));
        };
        const auto f = [&](double t) {
            const double d = 2 * z - t, left = -window.x - aside.x, right = window.x - aside.x,
                         low = -window.y - aside.y, high = window.y - aside.y;
            const double solid_angle =
                corner(right, high, d) - corner(left, high, d) - corner(right, low, d) + corner(left, low, d);
            return sigma * std::exp(-sigma * t) * solid_angle / (4 * pi);
        };
        return tyndall::test::integrate(f, 0, 2 * z - 1e-9, 1e-9);
    }
};

TEST(SkyLight, AWindowLightsTheAirByItsSolidAngle) {
    const RoomWithWindow w;
    for (const dvec2 aside : {dvec2(0.1, -0.1), dvec2(-1.2, 0.7)}) {
        expect_close(w.from_far_wall(aside, 1 << 18).radiance, w.expected(aside) * even_radiance, 3e-3);
    }
}

// The root mean square of 24 rays' errors, through a window that is a 200th of the sky: halved, on the mean, each
// time that there are four times the samples, and about what is estimated.
TEST(SkyLight, FourTimesTheSamplesHalveTheErrorAndItIsKnown) {
    const RoomWithWindow w;
    double first = 0;
    for (const int samples : {1 << 10, 1 << 12, 1 << 14, 1 << 16}) {
        double squares = 0, estimated = 0;
        constexpr int rays = 24;
        for (int i = 0; i < rays; ++i) {
            const dvec2 aside(1.5 * std::cos(2.4 * i) * i / rays, 1.5 * std::sin(2.4 * i) * i / rays);
            const double expected = w.expected(aside) * even_radiance.x;
            const auto [radiance, error] = w.from_far_wall(aside, samples);
            squares += std::pow(radiance.x / expected - 1, 2) / rays;
            estimated += std::pow(error / expected, 2) / rays;
        }
        const double error = std::sqrt(squares);
        RecordProperty("error_of_" + std::to_string(samples), std::to_string(error));
        if (first == 0) first = error;
        EXPECT_LE(error, first * std::sqrt(1024.0 / samples)) << samples;
        EXPECT_LE(error, 1.5 * std::sqrt(estimated)) << samples;
        EXPECT_GE(error, 0.3 * std::sqrt(estimated)) << samples;
    }
    EXPECT_LE(first, 0.4);
}

TEST(SkyLight, ScalesWithTheSky) {
    const SkyTable bright([](dvec3 d) { return 1000.0 * clear_sky(d); });
    SkyWorld w;
    w.medium(Shape::global, 0.05f, 0, 0.6f);
    w.room({0.5f, 0.3f}, {0.4f, 0.4f});
    expect_close(w.along(bright, dvec3(0), {1, 0, 0}, 2).radiance,
                 1000.0 * w.along(sky_at_day(), dvec3(0), {1, 0, 0}, 2).radiance, 1e-9);
    expect_close(w.reflected_from_above(bright, dvec3(0)), 1000.0 * w.reflected_from_above(sky_at_day(), dvec3(0)),
                 1e-9);
}

/// Diffuse alone.
void make_matt(World& w, glm::vec3 color) {
    Material& m = w.scene.materials[0];
    m.base_color = glm::vec4(color, 1);
    m.metallic = 0;
    m.dielectric_f0 = 0;
}

TEST(SkyLight, AFloorUnderTheOpenSkyReflectsItsIrradiance) {
    SkyWorld w;
    const glm::vec3 albedo(0.25f, 0.5f, 0.75f);
    make_matt(w, albedo);
    w.quad(w.mesh(), {-50, 0, -50}, {0, 0, 100}, {100, 0, 0});
    const dvec3 irradiance = 4 * pi * sphere_mean([](dvec3 d) { return std::max(d.y, 0.0) * clear_sky(d); });
    expect_close(w.reflected_from_above(sky_at_day(), {0, 1, 0}, 1 << 17), dvec3(albedo) * irradiance / pi, 1e-3);
}

// The form factor of a rectangle above a point of the floor, from its four quarters (Howell's C-11).
TEST(SkyLight, ASkylightLightsTheFloorByItsFormFactor) {
    SkyWorld w;
    make_matt(w, glm::vec3(1));
    const glm::vec2 half(0.8f, 0.5f);
    w.room({0, 0}, half);
    const double a = double{half.x} / 4, b = double{half.y} / 4;  // over the height
    const double of_a = std::sqrt(1 + a * a), of_b = std::sqrt(1 + b * b);
    const double quarter = (a / of_a * std::atan(b / of_a) + b / of_b * std::atan(a / of_b)) / (2 * pi);
    expect_close(w.reflected_from_above(even_sky(), {0, 0, 0}, 1 << 18), 4 * quarter * even_radiance, 3e-3);
}

TEST(SkyLight, AMirrorShowsTheSkyWhereNothingStandsBeforeIt) {
    for (const bool covered : {false, true}) {
        SkyWorld w;
        Material& m = w.scene.materials[0];
        m.metallic = 1;
        m.roughness = 0.045f;
        w.quad(w.mesh(), {-5, 0, -5}, {0, 0, 10}, {10, 0, 0});
        if (covered) w.quad(w.mesh(), {-1, 3, -1}, {2, 0, 0}, {0, 0, 2});
        const dvec3 seen = w.reflected_from_above(sky_at_day(), {0, 1, 0});
        if (covered)
            EXPECT_LT(seen.x, 0.01 * clear_sky({0, 1, 0}).x);
        else
            expect_close(seen, clear_sky({0, 1, 0}), 0.01);
    }
}

// A room's picture goes through Reference: off, the walls do not matter; on, they do, and the factor counts.
TEST(SkyLight, ReferenceAsksItWhenSkyVisibilityIsOn) {
    World w;
    w.sun(glm::vec3(to_sun), glm::vec3(20000));
    w.scene.lights[0].shadow = true;
    w.medium(Shape::global, 0.05f, 0, 0.3f);
    World open = w;
    w.box(w.mesh(), {-2, -2, -2}, {2, 2, 2});
    Settings settings = World::exact();
    settings.black_surfaces = false;
    settings.ambient = 0.4;
    const dvec3 d = glm::normalize(dvec3(0.3, 0.2, 1));
    const Reference::Ray off = w.trace(dvec3(0), d, settings);
    const double share = -std::expm1(-double{0.05f} * off.distance);
    expect_close(off.scattering, 0.4 * sky_at_day().mean() * share, 1e-3);
    EXPECT_GT(off.background.x, 0);
    settings.sky_visibility = true;
    const Reference::Ray on = w.trace(dvec3(0), d, settings);
    EXPECT_EQ(on.scattering, dvec3(0));
    EXPECT_EQ(on.background, dvec3(0));
    open.scene.lights[0].shadow = false;
    const dvec3 lit = open.trace(dvec3(0), d, settings).scattering;
    settings.ambient = 0;
    const dvec3 sun_alone = open.trace(dvec3(0), d, settings).scattering;
    expect_close(lit - sun_alone, 0.4 * convolved(clear_sky, double{0.3f}, d, 150), 5e-3);
}

}  // namespace
}  // namespace tyndall::reference