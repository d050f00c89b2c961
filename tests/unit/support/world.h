#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtx/quaternion.hpp>
#include <limits>
#include <numbers>

#include "reference/reference.h"
#include "support/scene_of_triangles.h"

namespace tyndall::reference::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Henyey and Greenstein, written again.
inline double phase(double g, double cosine) {
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// A scene with lights and media, traced exactly.
struct World : SceneOfTriangles {
    Light& light(LightType type, glm::vec3 position, glm::vec3 shines_along, glm::vec3 intensity) {
        Node& node = scene.nodes.emplace_back();
        node.world = glm::mat4_cast(glm::rotation(glm::vec3(0, 0, -1), glm::normalize(shines_along)));
        node.world[3] = glm::vec4(position, 1);
        Light& light = scene.lights.emplace_back();
        light.type = type;
        light.intensity = intensity;
        light.node = static_cast<int>(scene.nodes.size()) - 1;
        return light;
    }
    Light& sun(glm::vec3 towards, glm::vec3 lux = {3, 2, 1}) {
        return light(LightType::sun, {0, 0, 0}, -towards, lux);
    }
    Light& point(glm::vec3 position, float range, glm::vec3 candela = {30, 20, 10}) {
        Light& lamp = light(LightType::point, position, {0, -1, 0}, candela);
        lamp.range = range;
        return lamp;
    }
    Medium& medium(Medium::Shape shape, float sigma_s, float sigma_a, float g = 0) {
        Medium& m = scene.media.emplace_back();
        m.shape = shape;
        m.sigma_s = glm::vec3(sigma_s);
        m.sigma_a = glm::vec3(sigma_a);
        m.anisotropy = g;
        m.height_profile = shape == Medium::Shape::height;
        return m;
    }
    /// Faces +Z.
    void wall(float z) { quad(mesh(), {-50, -50, z}, {100, 0, 0}, {0, 100, 0}); }
    [[nodiscard]] Reference::Ray trace(dvec3 origin, dvec3 direction, Settings settings = exact()) const {
        return Reference(scene, settings).trace(origin, direction, 0);
    }
    static Settings exact() { return {.ambient = 0, .black_surfaces = true, .tolerance = 1e-8}; }
};

inline void expect_close(const dvec3& found, const dvec3& expected, double relative) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], relative * std::abs(expected[i])) << i;
}

inline const dvec3 sun_lux(3, 2, 1), lamp_candela(30, 20, 10);

}  // namespace tyndall::reference::test
