#include "reference/density_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/core/error.h"
#include "tests/support/voxels.h"

namespace tyndall::reference {
namespace {

using test::Voxels;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Interval all{-infinity, infinity};

DensityField field(const Voxels& voxels, bool nearest) {
    return {*voxels.grid(), nearest};
}

Voxels one_voxel(glm::ivec3 where, float value = 1) {
    Voxels voxels;
    voxels.set(where, value);
    return voxels;
}

/// Lumps of voxels here and there, on both sides of 0, most of the box empty.
Voxels sparse(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> place(-30, 30), size(0, 6), one_in_three(0, 2);
    std::uniform_real_distribution<float> value(0.01f, 5);
    Voxels voxels;
    for (int lump = 0; lump < 6; ++lump) {
        const glm::ivec3 low(place(random), place(random), place(random));
        const glm::ivec3 high = low + glm::ivec3(size(random), size(random), size(random));
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    if (one_in_three(random) != 0) voxels.set({x, y, z}, value(random));
    }
    return voxels;
}

struct Ray {
    dvec3 origin, direction;
    Interval part;
};

/// Rays of all kinds past and through some voxel: slanted, along axes, in planes of centres and of faces, through
/// corners, from inside and from far away.
class Rays {
  public:
    Rays(const Voxels& voxels, unsigned seed) : random_(seed) {
        for (const auto& [at, value] : voxels.values) targets_.emplace_back(at[0], at[1], at[2]);
    }
    Ray next() {
        const int kind = count_++ % 10;
        dvec3 through = targets_[random_() % targets_.size()];
        if (kind < 5) through += dvec3(unit(), unit(), unit());
        if (kind == 6) through += 0.5;                    // corners of cubes
        if (kind == 7) through += dvec3(0.5, 0, unit());  // faces
        dvec3 d(unit(), unit(), unit());
        if (kind == 2 || kind == 7) d[static_cast<int>(random_() % 3)] = 0;
        if (kind == 3 || kind == 8) {
            const int axis = static_cast<int>(random_() % 3);
            for (int i = 0; i < 3; ++i) d[i] = i == axis ? (unit() < 0 ? -1 : 1) : 0;
        }
        if (kind == 4 || kind == 9)  // along diagonals
            for (int i = 0; i < 3; ++i) d[i] = unit() < -0.3 ? -1 : unit() < 0 ? 0 : 1;
        if (d == dvec3(0)) d.x = 1;
        d /= glm::length(d);
        const double before = 60 + 40 * unit();
        Interval part{0, before + 60 + 40 * unit()};
        if (kind == 1 || kind == 9) part = {before - 3 + unit(), before + 3 + unit()};  // ends inside
        return {through - before * d, d, part};
    }

  private:
    double unit() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
    std::mt19937 random_;
    std::vector<dvec3> targets_;
    int count_ = 0;
};

TEST(ReferenceDensityField, OneVoxelIsATentOfOneVoxelLength) {
    for (const glm::ivec3 where : {glm::ivec3(3, -5, 9), glm::ivec3(0), glm::ivec3(7, 8, -1), glm::ivec3(-8)}) {
        const DensityField f = field(one_voxel(where), false);
        const dvec3 c(where);
        EXPECT_EQ(f.at(c), 1);
        EXPECT_DOUBLE_EQ(f.at(c + dvec3(0.25, 0, 0)), 0.75);
        EXPECT_DOUBLE_EQ(f.at(c + dvec3(-0.25, 0.5, -0.5)), 0.75 * 0.5 * 0.5);
        EXPECT_EQ(f.at(c + dvec3(0, 1.001, 0)), 0);
        EXPECT_EQ(f.lower(), c - 1.0);
        EXPECT_EQ(f.upper(), c + 1.0);
        for (int i = 0; i < 3; ++i) {
            dvec3 d(0), aside(0.25);
            d[i] = 1;
            aside[i] = 0;
            aside[(i + 1) % 3] = -0.5;
            EXPECT_DOUBLE_EQ(f.integral(c - 9.0 * d, d, {0, infinity}), 1);
            EXPECT_DOUBLE_EQ(f.integral(c + 9.0 * d, -d, {0, infinity}), 1);
            EXPECT_DOUBLE_EQ(f.integral(c, d, {0, infinity}), 0.5);
            EXPECT_NEAR(f.integral(c + aside, d, all), 0.75 * 0.5, 1e-15);
            EXPECT_EQ(f.integral(c + 1.5 * d, d, {0, infinity}), 0);
        }
        // (1 - |t|)³ and (1 - |t|)² from -1 to 1
        EXPECT_NEAR(f.integral(c, dvec3(1, 1, 1), all), 0.5, 1e-15);
        EXPECT_NEAR(f.integral(c, dvec3(-1, 1, -1), all), 0.5, 1e-15);
        EXPECT_NEAR(f.integral(c, dvec3(1, 0, -1), all), 2.0 / 3, 1e-15);
    }
}

TEST(ReferenceDensityField, NearestIsTheChordOfTheCube) {
    const dvec3 c(7, -8, 16);
    const DensityField f = field(one_voxel(glm::ivec3(c), 2), true);
    EXPECT_EQ(f.at(c + dvec3(0.49, -0.49, 0.49)), 2);
    EXPECT_EQ(f.at(c + dvec3(0.51, 0, 0)), 0);
    EXPECT_EQ(f.lower(), c - 0.5);
    EXPECT_EQ(f.upper(), c + 0.5);
    EXPECT_DOUBLE_EQ(f.integral(c, dvec3(0, 1, 0), all), 2);
    EXPECT_DOUBLE_EQ(f.integral(c + dvec3(0.3, 0, -0.4), dvec3(0, 1, 0), all), 2);
    EXPECT_EQ(f.integral(c + dvec3(0.6, 0, 0), dvec3(0, 1, 0), all), 0);
    EXPECT_DOUBLE_EQ(f.integral(c, dvec3(1, 1, 1), all), 2);
    EXPECT_DOUBLE_EQ(f.integral(c + dvec3(0.25, 0, 0), dvec3(1, 1, 0), all), 2 * 0.75);
    EXPECT_DOUBLE_EQ(f.integral(c, dvec3(4, 1, 0), all), 2 * 0.25);  // in units of the direction's length
    EXPECT_DOUBLE_EQ(f.integral(c, dvec3(1, 0, 0), {0.25, 9}), 2 * 0.25);
}

TEST(ReferenceDensityField, ABoxOfOnesIsItsLength) {
    Voxels voxels;
    voxels.fill(glm::ivec3(-11, 2, 5), glm::ivec3(14, 20, 40), 1);
    const dvec3 d = glm::normalize(dvec3(3, -1, 2)), middle(1, 11, 22);
    for (const bool nearest : {false, true}) {
        const DensityField f = field(voxels, nearest);
        EXPECT_NEAR(f.integral(middle, d, {-9, 8}), 17, 1e-12);
        EXPECT_NEAR(f.integral(middle, d, {0, 0.01}), 0.01, 1e-15);
        // A trilinear ramp at either end makes up for the half voxels outside of the centres.
        EXPECT_NEAR(f.integral(middle, dvec3(1, 0, 0), all), 26, 1e-12);
        EXPECT_NEAR(f.integral(middle, dvec3(0, 0, -1), all), 36, 1e-12);
    }
}

TEST(ReferenceDensityField, RandomRaysAgainstEveryPlaneOfTheLattice) {
    for (const bool nearest : {false, true})
        for (unsigned seed = 1; seed <= 4; ++seed) {
            const Voxels voxels = sparse(seed);
            const DensityField f = field(voxels, nearest);
            Rays rays(voxels, seed);
            int crossed = 0;
            for (int i = 0; i < 250; ++i) {
                const Ray ray = rays.next();
                const double expected =
                    voxels.integral(ray.origin, ray.direction, ray.part.begin, ray.part.end, nearest);
                if (expected > 0) ++crossed;
                const double found = f.integral(ray.origin, ray.direction, ray.part);
                EXPECT_NEAR(found, expected, 1e-10) << nearest << " " << seed << " " << i;
            }
            EXPECT_GT(crossed, 200);
        }
}

TEST(ReferenceDensityField, RandomRaysAgainstMidpointSums) {
    const Voxels voxels = sparse(9);
    constexpr int parts = 200000;
    for (const bool nearest : {false, true}) {
        const DensityField f = field(voxels, nearest);
        Rays rays(voxels, 5);
        for (int i = 0; i < 10; ++i) {
            const Ray ray = rays.next();
            if (i == 3 || i >= 6) continue;  // along faces
            const double step = (ray.part.end - ray.part.begin) / parts;
            double sum = 0;
            for (int k = 0; k < parts; ++k)
                sum += step * voxels.at(ray.origin + (ray.part.begin + (k + 0.5) * step) * ray.direction, nearest);
            EXPECT_NEAR(f.integral(ray.origin, ray.direction, ray.part), sum, nearest ? 2e-2 : 1e-5) << i;
        }
    }
}

TEST(ReferenceDensityField, LinesInThePlanesOfTheLattice) {
    Voxels voxels;
    voxels.fill(glm::ivec3(0), glm::ivec3(3), 2);
    const DensityField linear = field(voxels, false), cubes = field(voxels, true);
    // Through centres, where cells meet, and along an edge of cells.
    EXPECT_NEAR(linear.integral(dvec3(-9, 1, 2), dvec3(1, 0, 0), all), 8, 1e-13);
    EXPECT_NEAR(linear.integral(dvec3(9, 0, 3), dvec3(-1, 0, 0), all), 8, 1e-13);
    EXPECT_EQ(linear.integral(dvec3(9, -1, 3), dvec3(-1, 0, 0), all), 0);
    EXPECT_EQ(linear.integral(dvec3(9, 4, 3), dvec3(-1, 0, 0), all), 0);
    // In a face of the cubes: the voxel floor(p + 1/2), whose lower faces are its own.
    EXPECT_NEAR(cubes.integral(dvec3(-9, 1.5, 2), dvec3(1, 0, 0), all), 8, 1e-13);
    EXPECT_NEAR(cubes.integral(dvec3(9, -0.5, 2), dvec3(-1, 0, 0), all), 8, 1e-13);
    EXPECT_EQ(cubes.integral(dvec3(9, 3.5, 2), dvec3(-1, 0, 0), all), 0);
}

TEST(ReferenceDensityField, PartsAddUp) {
    const Voxels voxels = sparse(12);
    std::mt19937 random(3);
    for (const bool nearest : {false, true}) {
        const DensityField f = field(voxels, nearest);
        Rays rays(voxels, 8);
        for (int i = 0; i < 200; ++i) {
            const Ray ray = rays.next();
            const Interval whole = ray.part;
            const double total = f.integral(ray.origin, ray.direction, whole);
            double sum = 0, from = whole.begin;
            for (int k = 1; k <= 5; ++k) {
                const double share = k == 5 ? 1 : std::uniform_real_distribution<double>(0, 1)(random);
                const double to = from + share * (whole.end - from);
                sum += f.integral(ray.origin, ray.direction, {from, to});
                from = to;
            }
            EXPECT_NEAR(sum, total, 1e-11) << i;
            EXPECT_EQ(f.integral(ray.origin, ray.direction, {whole.end, whole.begin}), 0);
        }
    }
}

TEST(ReferenceDensityField, IsLinearInTheVoxels) {
    const Voxels a = sparse(21), b = sparse(22);
    Voxels sum;
    for (const Voxels* part : {&a, &b})
        for (const auto& [at, value] : part->values) sum.values[at] += 2 * value;
    for (const bool nearest : {false, true}) {
        const DensityField fa = field(a, nearest), fb = field(b, nearest), both = field(sum, nearest);
        Rays rays(sum, 8);
        for (int i = 0; i < 200; ++i) {
            const Ray r = rays.next();
            const double parts =
                fa.integral(r.origin, r.direction, r.part) + fb.integral(r.origin, r.direction, r.part);
            EXPECT_NEAR(both.integral(r.origin, r.direction, r.part), 2 * parts, 1e-5 * (1 + parts)) << i;
        }
    }
}

TEST(ReferenceDensityField, PointsAreTheVoxels) {
    const Voxels voxels = sparse(31);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(-34, 40);
    for (const bool nearest : {false, true}) {
        const DensityField f = field(voxels, nearest);
        int dense = 0;
        for (int i = 0; i < 200000; ++i) {
            const dvec3 p(place(random), place(random), place(random));
            const double expected = voxels.at(p, nearest);
            EXPECT_NEAR(f.at(p), expected, 1e-13);
            if (expected == 0) continue;
            ++dense;
            EXPECT_TRUE(glm::all(glm::lessThanEqual(f.lower(), p)) && glm::all(glm::lessThanEqual(p, f.upper())));
        }
        EXPECT_GT(dense, nearest ? 80 : 200);
    }
}

TEST(ReferenceDensityField, ALineIsTheIntegralUpToAnywhere) {
    const Voxels voxels = sparse(41);
    std::mt19937 random(6);
    for (const bool nearest : {false, true}) {
        const DensityField f = field(voxels, nearest);
        Rays rays(voxels, 2);
        for (int i = 0; i < 100; ++i) {
            const Ray ray = rays.next();
            const DensityLine line = f.line(ray.origin, ray.direction, ray.part, 3);
            const std::vector<double> knots = line.knots();
            EXPECT_TRUE(std::is_sorted(knots.begin(), knots.end()));
            EXPECT_EQ(std::adjacent_find(knots.begin(), knots.end()), knots.end());
            for (int k = 0; k < 20; ++k) {
                const double end = std::uniform_real_distribution<double>(-5, ray.part.end)(random);
                EXPECT_NEAR(line.integral_to(end), 3 * f.integral(ray.origin, ray.direction, {ray.part.begin, end}),
                            1e-10);
            }
            EXPECT_NEAR(line.integral_to(infinity), 3 * f.integral(ray.origin, ray.direction, ray.part), 1e-10);
        }
    }
}

TEST(ReferenceDensityField, AnEmptyGridIsNothing) {
    const DensityField f(DensityGrid{}, false);
    EXPECT_EQ(f.at(dvec3(0)), 0);
    EXPECT_EQ(f.integral(dvec3(-1, 0, 0), dvec3(1, 0, 0), all), 0);
    EXPECT_TRUE(f.line(dvec3(-1, 0, 0), dvec3(1, 0, 0), all, 1).knots().empty());
}

TEST(ReferenceDensityField, VoxelsTooFarApartAreAnError) {
    Voxels voxels = one_voxel(glm::ivec3(-1000000000));
    voxels.set(glm::ivec3(1000000000), 1);
    EXPECT_THROW(field(voxels, false), Error);
    EXPECT_THROW(field(one_voxel(glm::ivec3(0, -2000000000, 0)), true), Error);
}

}  // namespace
}  // namespace tyndall::reference
