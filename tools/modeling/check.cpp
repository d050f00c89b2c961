#include "tools/modeling/check.h"

#include <algorithm>
#include <cmath>

namespace tyndall::modeling {

namespace {

bool finite(const Vertex& v) {
    return std::isfinite(glm::dot(v.position, vec3(1)) + v.uv.x + v.uv.y) &&
           std::abs(glm::length(v.normal) - 1.0f) < 1e-3f;
}

bool unit(vec4 q) {
    return std::abs(glm::length(q) - 1.0f) < 1e-5f;
}

}  // namespace

std::vector<std::string> check_scene(const Scene& scene) {
    std::vector<std::string> failures;
    for (const Mesh& mesh : scene.meshes) {
        for (const auto& [surface, part] : mesh.parts) {
            if (!std::ranges::all_of(part.vertices, finite))
                failures.push_back("mesh " + mesh.name +
                                   ": a vertex is not finite or its normal not of unit length");
        }
    }
    for (const Node& n : scene.nodes) {
        if (!unit(vec4(n.rotation.x, n.rotation.y, n.rotation.z, n.rotation.w)))
            failures.push_back("node " + n.name + ": rotation is not of unit length");
    }
    for (const Animation& a : scene.animations) {
        for (const Channel& c : a.channels) {
            if (c.rotation && !std::ranges::all_of(c.values, unit))
                failures.push_back("animation " + a.name + ": a rotation is not of unit length");
        }
    }
    return failures;
}

}  // namespace tyndall::modeling
