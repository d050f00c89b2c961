// Where light ends (shaders/interface/shadow_maps.glsl), from the engine's maps, against rays through boxes.

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "support/shadow_rig.h"

namespace tyndall {
namespace {

using Point = ShadowRig::Point;
using Lookup = ShadowRig::Lookup;

/// Distance from `from` along the unit `direction` to the first box, if there is one.
std::optional<double> first_hit(std::span<const TestBox> boxes, glm::dvec3 from, glm::dvec3 direction) {
    std::optional<double> first;
    for (const TestBox& box : boxes) {
        double enter = 0, leave = 1e9;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (box.min[axis] - from[axis]) / direction[axis];
            const double b = (box.max[axis] - from[axis]) / direction[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        if (enter < leave && (!first || enter < *first)) first = enter;
    }
    return first;
}

/// The same, if it differs by less than `most` from what rays beside it meet.
std::optional<double> steady_hit(const std::function<double(glm::dvec2)>& hit, double radius, double most) {
    const double middle = hit({0, 0});
    for (int i = 0; i < 16; ++i) {
        const double a = i * 0.3926991;
        if (!(std::abs(hit(radius * glm::dvec2(std::cos(a), std::sin(a))) - middle) < most)) return std::nullopt;
    }
    return middle;
}

class ShadowOccluder : public GlTest {
  protected:
    const std::vector<TestBox> court{{{-40, -1, -40}, {40, 0, 40}}, {{-1, 0, -1}, {1, 2, 1}},
                                     {{3, 0, -6}, {3.3f, 4, 2}},    {{-6, 3, -8}, {-2, 3.4f, -3}},
                                     {{-12, 0, -30}, {-8, 9, -26}}, {{5, 5, -14}, {11, 5.3f, -8}}};
    std::mt19937 random{5};

    [[nodiscard]] glm::dvec3 in_the_court() {
        std::uniform_real_distribution<double> u(0, 1);
        return glm::mix(glm::dvec3(-15, 0, -42), glm::dvec3(12, 6, 6), glm::dvec3(u(random), u(random), u(random)));
    }
};

TEST_F(ShadowOccluder, OfTheSunIsTheFirstBoxOnItsRay) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(-0.5, -0.7, -0.4));
    Scene scene = box_scene(court);
    Light sun;
    sun.type = LightType::sun;
    add_light(scene, sun, {0, 0, 0}, direction);
    ShadowRig rig(std::move(scene));
    rig.view = look_at({0, 3, 12}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);
    rig.frame();
    const glm::dvec3 u = glm::normalize(glm::cross(direction, glm::dvec3(0, 1, 0))), v = glm::cross(direction, u);
    std::vector<Point> points;
    std::vector<double> expected;
    while (points.size() < 10000) {
        const glm::dvec3 p = in_the_court();
        // The coarsest map: the point may lie outside of all others.
        const double texel = rig.data.sun_static_texel.x;
        const auto hit = [&](glm::dvec2 beside) {
            const glm::dvec3 q = p + beside.x * u + beside.y * v;
            const auto distance = first_hit(court, q - 300.0 * direction, direction);
            return distance ? 300 - *distance : -1e9;
        };
        if (const auto truth = steady_hit(hit, 2 * texel, 6 * texel)) {
            points.push_back({p, rig.view_depth(p)});
            expected.push_back(*truth);
        }
    }
    const std::vector<float> values = rig.look_up(Lookup::sun_occluder, points);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) worst = std::max(worst, std::abs(values[i] - expected[i]));
    EXPECT_LT(worst, 2 * rig.data.sun_static_texel.x);
    EXPECT_GT(std::ranges::count_if(expected, [](double d) { return d > 0; }), 500) << "in the shadow";
}

TEST_F(ShadowOccluder, OfALampIsTheFirstBoxOnItsRay) {
    for (const LightType type : {LightType::point, LightType::spot}) {
        Scene scene = box_scene(court);
        Light light;
        light.type = type;
        light.range = 60;
        light.intensity = glm::vec3(1000);
        light.inner_cone = 0.7f;
        light.outer_cone = 0.9f;
        const glm::vec3 position(-2, 7, 1), axis(glm::normalize(glm::vec3(0.3f, -1, -0.5f)));
        add_light(scene, light, position, axis);
        ShadowRig rig(std::move(scene));
        rig.settings.tile_size_max = 512;
        rig.view = look_at({0, 3, 12}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);
        rig.frame();
        std::vector<Point> points;
        std::vector<double> expected, reach;
        while (points.size() < 10000) {
            const glm::dvec3 p = in_the_court();
            const double distance = glm::length(p - glm::dvec3(position));
            const glm::dvec3 direction = (p - glm::dvec3(position)) / distance;
            if (type == LightType::spot && glm::dot(direction, glm::dvec3(axis)) < std::cos(0.9)) continue;
            const glm::dvec3 u = glm::normalize(glm::cross(direction, glm::dvec3(0.1, 1, 0.2))),
                             v = glm::cross(direction, u);
            const auto hit = [&](glm::dvec2 beside) {
                const auto first =
                    first_hit(court, position, glm::normalize(direction + beside.x * u + beside.y * v));
                return first ? *first : 1e9;
            };
            const double texel = 3.5 / 512;  // as seen from the lamp, at most
            const auto truth = steady_hit(hit, 2 * texel, 0.25);
            if (!truth || *truth > 55) continue;
            points.push_back({.world = p, .light = 0});
            expected.push_back(distance - *truth);
            reach.push_back(*truth);
        }
        const std::vector<float> values = rig.look_up(Lookup::light_occluder, points);
        double worst = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
            worst = std::max(worst, std::abs(values[i] - expected[i]) / reach[i]);
        EXPECT_LT(worst, 0.03) << (type == LightType::spot ? "spot" : "point");
    }
}

}  // namespace
}  // namespace tyndall
