#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "reference/inscatter.h"
#include "reference/media.h"
#include "reference/media_ray.h"
#include "support/scene_of_triangles.h"
#include "tests/support/voxels.h"

namespace tyndall::reference {
namespace {

using tyndall::test::Voxels;

constexpr double infinity = std::numeric_limits<double>::infinity();

Medium medium_of(const std::shared_ptr<DensityGrid>& grid, bool nearest) {
    Medium m;
    m.shape = Medium::Shape::grid;
    m.grid = grid;
    m.nearest = nearest;
    m.sigma_s = glm::vec3(0.5f);
    m.sigma_a = glm::vec3(0.25f);
    return m;
}
constexpr double sigma_t = 0.75;

double depth(const Media& media, dvec3 origin, dvec3 direction, double begin, double end) {
    return media.optical_depth(origin, direction, begin, end, true, 1e-9).x;
}

/// Lumps, one of them at 0, as clouds are: smooth, and empty in between.
Voxels cloud(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-9, 9), radius(2, 6);
    Voxels voxels;
    for (int lump = 0; lump < 5; ++lump) {
        const dvec3 c = lump == 0 ? dvec3(0) : dvec3(place(random), place(random), place(random));
        const double r = radius(random);
        for (int z = -16; z <= 16; ++z)
            for (int y = -16; y <= 16; ++y)
                for (int x = -16; x <= 16; ++x) {
                    const double inside = 1 - glm::length(dvec3(x, y, z) - c) / r;
                    if (inside > 0) voxels.values[{x, y, z}] += static_cast<float>(inside);
                }
    }
    return voxels;
}

/// The medium turned, scaled and moved, its grid sheared and stretched.
Medium placed(const std::shared_ptr<DensityGrid>& grid, bool nearest) {
    grid->index_to_grid = glm::dmat4(glm::dvec4(0.5, 0, 0, 0), glm::dvec4(0.2, 0.75, 0, 0),
                                     glm::dvec4(-0.1, 0.3, 1.25, 0), glm::dvec4(3, -2, 1, 1));
    Medium m = medium_of(grid, nearest);
    m.center = {10, -20, 5};
    m.rotation = glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, -1)));
    m.scale = 1.5f;
    m.density = 0.4f;
    return m;
}
/// What `placed` means, written again.
struct Placed {
    glm::dmat3 to_world;
    dvec3 center{10, -20, 5};
    Placed() {
        const glm::dmat3 grid(dvec3(0.5, 0, 0), dvec3(0.2, 0.75, 0), dvec3(-0.1, 0.3, 1.25));
        const dvec3 k = glm::normalize(dvec3(1, 2, -1));
        const double c = std::cos(double(0.7f)), s = std::sin(double(0.7f));
        glm::dmat3 turn;  // Rodrigues
        for (int i = 0; i < 3; ++i) {
            dvec3 e(0);
            e[i] = 1;
            turn[i] = c * e + s * glm::cross(k, e) + (1 - c) * glm::dot(k, e) * k;
        }
        to_world = 1.5 * turn * grid;
        center += 1.5 * turn * dvec3(3, -2, 1);
    }
    [[nodiscard]] dvec3 world(dvec3 voxel) const { return to_world * voxel + center; }
    [[nodiscard]] dvec3 voxel(dvec3 world) const { return glm::inverse(to_world) * (world - center); }
    [[nodiscard]] dvec3 turned(dvec3 direction) const { return glm::inverse(to_world) * direction; }
};

TEST(ReferenceGridMedium, ABoxOfOnesIsAHomogeneousMedium) {
    Voxels voxels;
    voxels.fill(glm::ivec3(-10), glm::ivec3(12, 9, 11), 1);
    const auto grid = voxels.grid();
    const dvec3 d = glm::normalize(dvec3(1, -2, 0.5));
    for (const bool nearest : {false, true}) {
        const Media upright({medium_of(grid, nearest)});
        EXPECT_NEAR(glm::exp(-depth(upright, dvec3(1, 0, 2), d, -3, 5)), std::exp(-sigma_t * 8), 1e-9);
        EXPECT_NEAR(depth(upright, dvec3(-40, 0.25, 0), dvec3(1, 0, 0), 0, infinity), sigma_t * 23, 1e-9);
        EXPECT_EQ(upright.at(dvec3(1, 2, 3)).sigma_t, dvec3(sigma_t));
    }
    for (const bool nearest : {false, true}) {
        const Placed as;
        const Media media({placed(grid, nearest)});
        const double thick = sigma_t * double(0.4f);
        EXPECT_NEAR(media.at(as.world(dvec3(3, -2, 1))).sigma_t.x, thick, 1e-7);
        EXPECT_NEAR(media.at(as.world(dvec3(3, -2, 1))).sigma_s.x, 0.5 * double(0.4f), 1e-7);
        EXPECT_NEAR(glm::exp(-depth(media, as.world(dvec3(1, 0, 2)), d, -3, 3)), std::exp(-thick * 6), 1e-6);
        // Along the voxels' second axis, from one face to the other: 20 voxels of that axis' length.
        const double edge = glm::length(as.to_world[1]);
        const dvec3 along = as.to_world[1] / edge;
        EXPECT_NEAR(depth(media, as.world(dvec3(1, 0.1, 2)), along, -100, 100), thick * 20 * edge, 1e-5);
    }
}

TEST(ReferenceGridMedium, RandomRaysAgainstTheVoxels) {
    const Placed as;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-12, 12), unit(-1, 1), before(0, 60);
    const Voxels voxels = cloud(3);
    for (const bool nearest : {false, true}) {
        const Media media({placed(voxels.grid(), nearest)});
        const MediumShape& shape = media.shapes().front();
        double greatest = 0;
        for (int i = 0; i < 1000; ++i) {
            const dvec3 through = as.world(dvec3(place(random), place(random), place(random)));
            const dvec3 d = glm::normalize(dvec3(unit(random), unit(random), unit(random)));
            const double back = before(random), end = back + before(random);
            const dvec3 o = through - back * d;
            const double thick = sigma_t * double(0.4f);
            const double expected = thick * voxels.integral(as.voxel(o), as.turned(d), 0, end, nearest);
            greatest = std::max(greatest, expected);
            // The rotation's single precision moves faces of voxels by 1e-6.
            EXPECT_NEAR(depth(media, o, d, 0, end), expected, 1e-5) << i;
            const auto path = shape.path(o, d);
            if (expected > 0) {
                ASSERT_TRUE(path);
            }
            if (!path) continue;
            EXPECT_NEAR(thick * voxels.integral(as.voxel(o), as.turned(d), std::max(path->inside.begin, 0.0),
                                                std::min(path->inside.end, end), nearest),
                        expected, 1e-5);
            const MediaRay ray(media, o, d, end, 1e-9);
            EXPECT_NEAR(ray.depth(end).x, expected, 1e-5) << i;
            EXPECT_NEAR(ray.depth(back).x, depth(media, o, d, 0, back), 1e-9) << i;
        }
        EXPECT_GT(greatest, 1);
    }
}

TEST(ReferenceGridMedium, ThePathIsTheBoxOfWhatIsThere) {
    Voxels voxels;
    voxels.set({3, 4, 5}, 1);
    voxels.set({6, 4, 9}, 2);
    const auto grid = voxels.grid();
    grid->index_to_grid = glm::dmat4(2.0);
    grid->index_to_grid[3] = glm::dvec4(1, 0, 0, 1);
    for (const bool nearest : {false, true}) {
        const double reach = nearest ? 0.5 : 1;
        const MediumShape shape(medium_of(grid, nearest));
        const auto path = shape.path(dvec3(-20, 8, 15), dvec3(1, 0, 0));
        ASSERT_TRUE(path);
        EXPECT_NEAR(path->inside.begin, 21 + 2 * (3 - reach), 1e-12);
        EXPECT_NEAR(path->inside.end, 21 + 2 * (6 + reach), 1e-12);
        EXPECT_FALSE(shape.path(dvec3(-20, 8 + 2.01 * reach, 15), dvec3(1, 0, 0)));
        EXPECT_FALSE(shape.path(dvec3(-20, 8, 18 + 2.01 * reach), dvec3(1, 0, 0)));
        EXPECT_TRUE(shape.path(dvec3(-20, 8 + 1.99 * reach, 15), dvec3(1, 0, 0)));
        EXPECT_EQ(shape.greatest_density(), 2);
    }
}

TEST(ReferenceGridMedium, EveryFaceBetweenCellsIsAKnot) {
    Voxels voxels;
    voxels.fill(glm::ivec3(0), glm::ivec3(2), 1);
    voxels.set({7, 1, 1}, 1);
    for (const bool nearest : {false, true}) {
        const Media media({medium_of(voxels.grid(), nearest)});
        const MediaRay ray(media, dvec3(-10, 1, 1), dvec3(1, 0, 0), infinity, 1e-9);
        const std::vector<double> faces = nearest ? std::vector<double>{-0.5, 0.5, 1.5, 2.5, 6.5, 7.5}
                                                  : std::vector<double>{-1, 0, 1, 2, 3, 6, 7, 8};
        for (const double x : faces)
            EXPECT_TRUE(std::ranges::any_of(ray.knots(), [&](double t) { return std::abs(t - 10 - x) < 1e-9; }))
                << nearest << " " << x;
        EXPECT_EQ(media.breakpoints(dvec3(-10, 1, 1), dvec3(1, 0, 0), 0, infinity).size(), faces.size());
    }
}

TEST(ReferenceGridMedium, WhatIsEmptyIsAbsent) {
    Voxels voxels;
    voxels.fill(glm::ivec3(0), glm::ivec3(2), 1);
    Medium none = medium_of(voxels.grid(), false), no_grid = none, no_density = none, clear = none;
    none.grid = std::make_shared<DensityGrid>();
    no_grid.grid = nullptr;
    no_density.density = 0;
    clear.sigma_s = clear.sigma_a = glm::vec3(0);
    EXPECT_TRUE(Media({none, no_grid, no_density, clear}).empty());
    EXPECT_FALSE(Media({medium_of(voxels.grid(), false)}).empty());
}

/// A sun, a lamp and the sky's even light, on nothing but media.
struct Lit {
    test::SceneOfTriangles world;
    Geometry geometry{world.scene, true};
    Lighting lighting;
    Settings settings{.tolerance = 1e-6};

    Lit() {
        lighting.suns.push_back({glm::normalize(dvec3(0.4, 0.8, 0.3)), dvec3(3, 2, 1), true});
        lighting.lamps.push_back({.position = {2, 3.5, -6},
                                  .axis = {0, -1, 0},
                                  .intensity = {20, 30, 10},
                                  .range = infinity,
                                  .radius = 0.01,
                                  .spot = false,
                                  .shadow = true,
                                  .cos_outer = -1,
                                  .cone_scale = 1});
        lighting.ambient = dvec3(0.1, 0.2, 0.3);
    }
    [[nodiscard]] dvec3 along(const Media& media, dvec3 o, dvec3 d, double end = infinity) const {
        const InScattering scattering(geometry, media, lighting, settings);
        const MediaRay ray(media, o, d, end, scattering.depth_tolerance());
        return scattering.along(ray, o, d).radiance;
    }
};

void expect_close(const dvec3& found, const dvec3& expected, double relative) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], relative * std::abs(expected[i])) << i;
}

Medium coloured(Medium m) {
    m.sigma_s = {0.02f, 0.03f, 0.05f};
    m.sigma_a = {0.01f, 0, 0.02f};
    m.emission = {0, 0.001f, 0.002f};
    m.anisotropy = 0.4f;
    return m;
}

TEST(ReferenceGridMedium, CubesOfOnesAreTheBox) {
    Voxels voxels;
    voxels.fill(glm::ivec3(-9, -4, -12), glm::ivec3(8, 10, 7), 1);
    const Lit lit;
    const Medium grid = coloured(medium_of(voxels.grid(), true));
    Medium box = coloured({});
    box.shape = Medium::Shape::box;
    box.center = {-0.5f, 3, -2.5f};
    box.half_extent = {9, 7.5f, 10};
    for (const dvec3 d : {dvec3(1, 0.1, 0.2), dvec3(-0.3, 1, 0.1), dvec3(0, 0, 1)})
        for (const double back : {0.0, 30.0}) {
            const dvec3 unit = glm::normalize(d), o = dvec3(0.3, 1.2, -2.7) - back * unit;
            const dvec3 expected = lit.along(Media({box}), o, unit);
            EXPECT_GT(expected.x, 1e-3);
            expect_close(lit.along(Media({grid}), o, unit), expected, 1e-5);
        }
}

TEST(ReferenceGridMedium, AWideSlabOfOnesIsASoftBox) {
    Voxels voxels;
    voxels.fill(glm::ivec3(-40, -3, -40), glm::ivec3(40, 3, 40), 1);
    const Lit lit;
    const Medium grid = coloured(medium_of(voxels.grid(), false));
    Medium box = coloured({});
    box.shape = Medium::Shape::box;
    box.half_extent = {41, 4, 41};
    box.softness = 1;
    for (const dvec3 d : {dvec3(0.5, -1, 0.2), dvec3(0, -1, 0), dvec3(-1, -0.8, -1)}) {
        const dvec3 unit = glm::normalize(d), o = -15.0 * unit;
        const dvec3 expected = lit.along(Media({box}), o, unit);
        EXPECT_GT(expected.x, 1e-3);
        expect_close(lit.along(Media({grid}), o, unit), expected, 1e-5);
    }
}

// L = E p ∫ σ_s ρ(t) exp(-σ_t (∫ over [0, t] + ∫ towards the sun)) dt, by midpoints of 20,000 parts.
TEST(ReferenceGridMedium, InScatteringIsTheSumOfItsPoints) {
    const Voxels voxels = cloud(11);
    Lit lit;
    lit.lighting.ambient = dvec3(0);
    lit.lighting.lamps.clear();
    lit.settings.tolerance = 1e-5;
    const Sun& sun = lit.lighting.suns.front();
    for (const bool nearest : {false, true}) {
        const Medium m = medium_of(voxels.grid(), nearest);
        const Media media({m});
        for (const dvec3 d : {dvec3(1, 0.1, 0.2), dvec3(-0.3, 1, 0.1), dvec3(0, 0, -1)}) {
            const dvec3 unit = glm::normalize(d), o = dvec3(0.3, 1.2, -2.7) - 25.0 * unit;
            constexpr int parts = 8000;
            constexpr double step = 50.0 / parts;
            double sum = 0, eye = 0;
            for (int i = 0; i < parts; ++i) {
                const dvec3 p = o + (i + 0.5) * step * unit;
                const double density = voxels.at(p, nearest);
                if (density == 0) continue;
                const double towards_sun = voxels.integral(p, sun.to_sun, 0, 60, nearest);
                sum += step * density * std::exp(-sigma_t * (eye + 0.5 * step * density + towards_sun));
                eye += step * density;
            }
            const double isotropic = 1 / (4 * std::acos(-1.0));
            EXPECT_GT(sum, 0.01);
            expect_close(lit.along(media, o, unit), 0.5 * isotropic * sum * sun.illuminance, nearest ? 2e-3 : 5e-5);
        }
    }
}

}  // namespace
}  // namespace tyndall::reference
