#include <algorithm>

#include "engine/scene/scene.h"

namespace tyndall {
namespace {

using glm::dmat3;
using glm::dvec3;

/// Of the product of lengths or the largest length: single precision leaves less than this of what is zero.
constexpr double rounding = 1e-6;

/// The linear part of a node's world transform with small scales in place of those of 0.
dmat3 not_flattened(const Scene& scene, int index) {
    constexpr double small = 1e-3;  // of the node's largest scale
    dmat3 linear(1);
    for (int i = index; i >= 0; i = scene.nodes[static_cast<std::size_t>(i)].parent) {
        const Node& node = scene.nodes[static_cast<std::size_t>(i)];
        const dvec3 size = glm::abs(dvec3(node.scale));
        const double largest = std::max({size.x, size.y, size.z});
        dmat3 local = glm::mat3_cast(glm::dquat(node.rotation));
        for (int axis = 0; axis < 3; ++axis)
            local[axis] *= size[axis] > 0 ? double{node.scale[axis]} : (largest > 0 ? small * largest : 1);
        linear = local * linear;
    }
    return linear;
}

}  // namespace

bool mirrors(const glm::mat4& world) {
    const dmat3 m(world);
    return glm::determinant(m) < -rounding * glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
}

glm::mat4 node_pose(const Scene& scene, int node) {
    const glm::mat4& world = scene.nodes[static_cast<std::size_t>(node)].world;
    const dmat3 linear(world);
    const double largest = std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
    const auto axis = [&](int i) {
        const double length = glm::length(linear[i]);
        return glm::normalize(length > rounding * largest ? linear[i] : not_flattened(scene, node)[i]);
    };
    const dvec3 back = axis(2);
    dvec3 up = axis(1);
    if (glm::length(glm::cross(up, back)) < rounding) up = not_flattened(scene, node)[1];
    const dvec3 right = glm::normalize(glm::cross(up, back));
    return {glm::vec4(right, 0), glm::vec4(glm::cross(back, right), 0), glm::vec4(back, 0), world[3]};
}

}  // namespace tyndall
