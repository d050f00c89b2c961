#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "reference/sky_table.h"
#include "reference/surface.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/sky_background.glsl"
TYNDALL_GLSL_END

namespace tyndall::reference {
namespace {

constexpr double pi = std::numbers::pi;

void expect_near(dvec3 found, dvec3 expected, double relative) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], relative * std::abs(expected[c])) << c;
}

TEST(SkyTable, ConstantAndLinearRadiance) {
    const SkyTable constant([](dvec3) { return dvec3(3, 2, 1); });
    expect_near(constant.mean(), {3, 2, 1}, 1e-12);
    dvec3 moment(0), flux(0);
    for (const SkyTable::Patch& patch : constant.patches()) {
        flux += patch.flux;
        moment += patch.flux.x * patch.direction;
    }
    expect_near(flux, 4 * pi * dvec3(3, 2, 1), 1e-12);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(moment[c], 0, 1e-3);
    for (const dvec3 d : {dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(1, 0, 0), dvec3(-0.6, 0, -0.8)})
        expect_near(constant.at(d), {3, 2, 1}, 1e-12);

    // int (1 + x + 2 y + 3 z²) / (4 pi) = 1 + 1
    const auto uneven = [](dvec3 d) { return dvec3(1 + d.x + 2 * d.y + 3 * d.z * d.z); };
    const SkyTable table(uneven);
    expect_near(table.mean(), dvec3(2), 2e-3);
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 200; ++i) {
        const dvec3 d = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
        EXPECT_NEAR(table.at(d).x, uneven(d).x, 0.02);
    }
}

Scene scene_with_sun(dvec3 to_sun, glm::vec3 lux) {
    Scene scene;
    Light& sun = scene.lights.emplace_back();
    sun.type = LightType::sun;
    sun.intensity = lux;
    sun.node = 0;
    const glm::vec3 z(glm::normalize(to_sun)), x = glm::normalize(glm::cross(glm::vec3(0, 1, 0.01f), z));
    scene.nodes.emplace_back().world =
        glm::mat4(glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), glm::vec4(0, 0, 0, 1));
    return scene;
}

const dvec3 to_sun = glm::normalize(dvec3(0.4, 0.5, -0.6));

/// The clear sky of that sun with 20000 lux, asked of the model itself.
dvec3 clear_sky(dvec3 d) {
    return dvec3(glsl::sky_radiance(glm::vec3(d), glm::vec3(to_sun), 20000));
}

/// What that sky is in the reference.
const Sky& sky_at_day(double factor) {
    static const Scene scene = scene_with_sun(to_sun, glm::vec3(20000));
    static const Sky whole(scene, 1), part(scene, 0.4);
    return factor == 1 ? whole : part;
}

/// Mean of f over the sphere, on a lattice of its own.
template <class F>
dvec3 sphere_mean(F f) {
    constexpr int n = 10000;
    dvec3 sum(0);
    for (int i = 0; i < n; ++i) {
        const double y = 1 - (2 * i + 1.0) / n, azimuth = i * pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - y * y);
        sum += f(dvec3(r * std::cos(azimuth), y, r * std::sin(azimuth)));
    }
    return sum / static_cast<double>(n);
}

// A moonless night sky has 22 magnitudes an arcsecond squared: 1.7e-4 cd/m² (108,000 times 10 to the power -0.4
// each).
TEST(Sky, WithoutASunItIsNight) {
    const double darkest = 1.08e5 * std::pow(10, -0.4 * 22);
    for (const glm::vec3 lux : {glm::vec3(-1), glm::vec3(0)}) {  // none; one that does not shine
        const Scene scene = lux.x < 0 ? Scene{} : scene_with_sun(to_sun, lux);
        const Sky sky(scene, 1);
        for (const double luminance : {sky.background({0, 1, 0}).y, 2 * sky.mean_radiance().y}) {
            EXPECT_GT(luminance, darkest);
            EXPECT_LT(luminance, 2 * darkest);
        }
        EXPECT_GT(sky.background({0, -1, 0}).y, 0);
    }
}

TEST(Sky, WithFactorZeroItIsSeenAndLightsNothing) {
    const Sky sky(scene_with_sun(to_sun, glm::vec3(20000)), 0);
    EXPECT_EQ(sky.mean_radiance(), dvec3(0));
    EXPECT_GT(sky.background({0, 1, 0}).z, 100);
}

TEST(Sky, MeanRadianceIsTheIntegralOfTheModel) {
    const Sky& sky = sky_at_day(0.4);
    expect_near(sky.mean_radiance(), 0.4 * sphere_mean(clear_sky), 2e-3);
    // A coloured sun counts by its luminance.
    const Scene green = scene_with_sun(to_sun, {0, 20000 / 0.7152f, 0});
    expect_near(Sky(green, 0.4).mean_radiance(), sky.mean_radiance(), 1e-5);
}

Surface upward(dvec3 base, double metallic, double roughness, double f0) {
    Surface s{};
    s.geometric_normal = {0, 1, 0};
    s.normal = glm::normalize(dvec3(0.1, 1, -0.3));
    s.base_color = base;
    s.metallic = metallic;
    s.roughness = roughness;
    s.occlusion = 0.5;
    s.dielectric_f0 = f0;
    return s;
}

TEST(Sky, ReflectedIsTheIntegralOfSkyAndBrdf) {
    const Sky& sky = sky_at_day(0.4);
    const dvec3 to_eye = glm::normalize(dvec3(0.5, 0.4, 0.5));
    for (const Surface& s : {upward({0.2, 0.5, 0.8}, 0, 0.5, 0), upward({0.2, 0.5, 0.8}, 0, 0.7, 0.04),
                             upward({0.9, 0.6, 0.3}, 1, 0.6, 0.04), upward(dvec3(0.5), 0.3, 1, 0.1)}) {
        const dvec3 expected =
            4 * pi * sphere_mean([&](dvec3 l) { return reflected(s, to_eye, l) * clear_sky(l); });
        expect_near(sky.reflected(s, to_eye), 0.4 * 0.5 * expected, 0.01);
    }
}

TEST(Sky, ASmoothMetalMirrorsIt) {
    const Sky& sky = sky_at_day(1);
    Surface mirror = upward(dvec3(1), 1, 0.045, 0.04);
    mirror.occlusion = 1;
    const dvec3 to_eye = glm::normalize(dvec3(-0.2, 0.8, 0.5));
    const dvec3 mirrored = 2 * glm::dot(mirror.normal, to_eye) * mirror.normal - to_eye;
    expect_near(sky.reflected(mirror, to_eye), clear_sky(mirrored), 0.02);
}

TEST(Sky, BehindTheSceneStandTheSkyTheCloudsAndTheDisc) {
    const Sky& sky = sky_at_day(0.4);
    // Below the horizon there are no clouds; the factor is not for what is seen.
    const dvec3 down = glm::normalize(dvec3(0.3, -0.5, 0.2));
    expect_near(sky.background(down), clear_sky(down), 1e-6);
    // The disc is cut off at what half floats hold, to its edge.
    const dvec3 aside = glm::normalize(glm::cross(to_sun, dvec3(0, 1, 0)));
    EXPECT_EQ(sky.background(to_sun).x, 60000);
    EXPECT_EQ(sky.background(glm::normalize(to_sun + 0.0046 * aside)).x, 60000);
    EXPECT_LT(sky.background(glm::normalize(to_sun + 0.0047 * aside)).x, 50000);
    // A disc that is not cut off gives the illuminance back: its radiance over its solid angle, in rings.
    const Sky dim(scene_with_sun(to_sun, glm::vec3(1)), 0);
    constexpr int rings = 200;
    double illuminance = 0;
    for (int i = 0; i < rings; ++i) {
        const double radius = 0.00465 * (i + 0.5) / rings;
        const dvec3 d = glm::normalize(to_sun + radius * aside);
        illuminance += dim.background(d).x * 2 * pi * radius * 0.00465 / rings;
    }
    EXPECT_NEAR(illuminance, 1, 0.01);
    // Some of the upper sky is clouded, and clouds are whiter than the sky.
    int clouded = 0;
    for (int i = 0; i < 400; ++i) {
        const dvec3 d = glm::normalize(dvec3(std::cos(0.9 * i), 0.3 + 0.001 * i, std::sin(0.9 * i)));
        const dvec3 seen = sky.background(d), clear = clear_sky(d);
        if (glm::distance(seen, clear) < 1e-3 * clear.y) continue;
        ++clouded;
        EXPECT_GT(seen.x / seen.z, clear.x / clear.z);
    }
    EXPECT_GT(clouded, 20);
    EXPECT_LT(clouded, 380);
}

}  // namespace
}  // namespace tyndall::reference
