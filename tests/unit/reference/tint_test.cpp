#include "reference/tint.h"

#include <gtest/gtest.h>

#include <random>

#include "support/glass.h"

namespace tyndall::reference {
namespace {

using namespace test;

/// Whether the line from p to q crosses the triangle: by the volumes of its tetrahedra.
bool crosses(const glm::vec3 (&corner)[3], dvec3 p, dvec3 q) {
    const dvec3 a(corner[0]), b(corner[1]), c(corner[2]);
    const auto volume = [](dvec3 o, dvec3 x, dvec3 y, dvec3 z) {
        return glm::dot(x - o, glm::cross(y - o, z - o)) > 0;
    };
    return volume(p, a, b, c) != volume(q, a, b, c) && volume(p, q, a, b) == volume(p, q, b, c) &&
           volume(p, q, b, c) == volume(p, q, c, a);
}

TEST(Tint, AgreesWithEveryTriangleOfATangle) {
    World w;
    std::mt19937 random(29);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&](double scale) { return scale * dvec3(unit(random), unit(random), unit(random)); };
    const auto share = [&] { return static_cast<float>(0.5 + 0.5 * unit(random)); };
    struct Pane {
        glm::vec3 corner[3];
        dvec3 filter;
    };
    std::vector<Pane> panes;
    for (int i = 0; i < 60; ++i) {
        const dvec3 at = vector(3);
        const Glass glass{{share(), share(), share(), share()}, share()};
        const Pane& pane = panes.emplace_back(Pane{{at, at + vector(3), at + vector(3)}, glass.filter()});
        World::triangle(glass.mesh(w), pane.corner[0], pane.corner[1], pane.corner[2]);
    }
    const Geometry geometry(w.scene, true);
    const auto expected = [&](dvec3 p, dvec3 light) {
        dvec3 product(1);
        for (const Pane& pane : panes)
            if (crosses(pane.corner, p, light)) product *= pane.filter;
        return product;
    };
    int tinted = 0;
    for (int i = 0; i < 500; ++i) {
        const dvec3 origin = vector(4), to_sun = glm::normalize(vector(1)), lamp = vector(4);
        // Every fifth along the light, or through the lamp.
        const dvec3 d = glm::normalize(vector(1)), along = i % 5 == 0 ? to_sun : d,
                    through = i % 5 == 0 ? glm::normalize(lamp - origin) : d;
        const Tint sun = geometry.tint_by_sun(origin, i % 2 == 0 ? along : -along, 0, 9, to_sun);
        const Tint bulb = geometry.tint_by_lamp(origin, through, 0, 9, lamp);
        for (int k = 0; k < 4; ++k) {
            const double t = 4.5 + 4.5 * unit(random);
            const dvec3 p = origin + (i % 2 == 0 ? t : -t) * along, q = origin + t * through;
            const dvec3 by_sun = expected(p, p + 100.0 * to_sun), by_lamp = expected(q, lamp);
            const double distance = glm::length(lamp - q);
            expect_close(sun.at(t), by_sun, 1e-6);
            expect_close(bulb.at(t), by_lamp, 1e-6);
            expect_close(geometry.tint(p, to_sun, infinity, 0), by_sun, 1e-6);
            expect_close(geometry.tint(q, (lamp - q) / distance, distance, 0), by_lamp, 1e-6);
            tinted += by_sun != dvec3(1);
        }
        if (HasFailure()) FAIL() << i;
    }
    EXPECT_GT(tinted, 500);
    EXPECT_LT(tinted, 1950);
}

// A lattice of squares: lines through its corners and along its edges cross one triangle each.
TEST(Tint, SharedEdgesAndCornersCountOnce) {
    World w;
    Mesh& mesh = red.mesh(w);
    for (int x = -4; x < 4; ++x)
        for (int z = -4; z < 4; ++z) World::quad(mesh, {float(x), 2, float(z)}, {1, 0, 0}, {0, 0, 1});
    const Geometry geometry(w.scene, true);
    for (int i = -12; i <= 12; ++i)
        for (int k = -12; k <= 12; ++k) {
            const dvec3 p(0.25 * i, 0, 0.25 * k);
            expect_close(geometry.tint(p, {0, 1, 0}, infinity, 0), red.filter(), 1e-12);
            expect_close(geometry.tint(p, {0, 1, 0}, 4, 0), red.filter(), 1e-12);
        }
    for (const dvec3 d : {dvec3(1, 0, 0), dvec3(0, 0, 1), glm::normalize(dvec3(1, 0, 1))})
        for (int i = 0; i < 30; ++i) {
            expect_close(geometry.tint_by_sun({-2, 0, -2}, d, 0, 4, {0, 1, 0}).at(0.125 * (i + 1)), red.filter(),
                         1e-12);
        }
}

TEST(Tint, WithoutGlassThereIsNone) {
    World w;
    w.wall(-5);
    const Geometry geometry(w.scene, true);
    EXPECT_TRUE(geometry.tint_by_sun(dvec3(0), {0, 0, 1}, 0, infinity, {0, 1, 0}).knots().empty());
    EXPECT_EQ(geometry.tint_by_lamp(dvec3(0), {0, 0, 1}, 0, infinity, {0, 1, 0}).at(3), dvec3(1));
}

}  // namespace
}  // namespace tyndall::reference
