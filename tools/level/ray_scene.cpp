#include "tools/level/ray_scene.h"

#include <algorithm>

namespace tyndall::level {

namespace {

// Squared distance from p to the triangle: the foot of the perpendicular where it falls inside, else the nearest
// edge.
float distance_squared(vec3 p, vec3 a, vec3 b, vec3 c) {
    auto edge = [&](vec3 u, vec3 v) {
        const vec3 d = v - u;
        const float t = glm::clamp(glm::dot(p - u, d) / std::max(glm::dot(d, d), 1e-12f), 0.0f, 1.0f);
        const vec3 r = p - u - d * t;
        return glm::dot(r, r);
    };
    const vec3 n = glm::cross(b - a, c - a);
    auto inside = [&](vec3 u, vec3 v) { return glm::dot(glm::cross(v - u, p - u), n) >= 0.0f; };
    if (inside(a, b) && inside(b, c) && inside(c, a)) {
        const float d = glm::dot(p - a, n);
        return d * d / glm::dot(n, n);
    }
    return std::min({edge(a, b), edge(b, c), edge(c, a)});
}

}  // namespace

RayScene::RayScene(const Level& level, const MaterialSet& materials, bool with_lamps) {
    for (size_t i = 0; i < level.nodes.size(); ++i) {
        const Node& node = level.nodes[i];
        if (node.mesh < 0 || (!with_lamps && !node.cast_shadow)) continue;
        const mat4 world = level.world(static_cast<int>(i));
        for (const auto& [mat, part] : level.meshes[static_cast<size_t>(node.mesh)].parts) {
            if (materials.materials[static_cast<size_t>(mat.material)].mask) continue;
            auto at = [&](size_t k) { return vec3(world * vec4(part.vertices[part.indices[k]].position, 1.0f)); };
            for (size_t k = 0; k < part.indices.size(); k += 3) triangles_.push_back({at(k), at(k + 1), at(k + 2)});
        }
    }
    build(0, triangles_.size());
}

size_t RayScene::build(size_t first, size_t count) {
    const size_t self = boxes_.size();
    Box box;
    for (size_t i = first; i < first + count; ++i) {
        const Triangle& t = triangles_[i];
        box.low = glm::min(box.low, glm::min(t.a, glm::min(t.b, t.c)));
        box.high = glm::max(box.high, glm::max(t.a, glm::max(t.b, t.c)));
    }
    boxes_.push_back(box);
    if (count <= 6) {
        boxes_[self].first = first;
        boxes_[self].count = count;
        return self;
    }
    const vec3 size = box.high - box.low;
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto half = static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(begin, begin + half, begin + static_cast<std::ptrdiff_t>(count),
                     [axis](const Triangle& x, const Triangle& y) {
                         return x.a[axis] + x.b[axis] + x.c[axis] < y.a[axis] + y.b[axis] + y.c[axis];
                     });
    build(first, count / 2);
    boxes_[self].right = build(first + count / 2, count - count / 2);
    return self;
}

bool RayScene::blocked(vec3 a, vec3 b) const {
    const vec3 d = b - a, inverse = 1.0f / d;
    std::vector<size_t> stack{0};
    while (!stack.empty()) {
        const size_t index = stack.back();
        stack.pop_back();
        const Box& box = boxes_[index];
        const vec3 t0 = (box.low - a) * inverse, t1 = (box.high - a) * inverse, lo = glm::min(t0, t1),
                   hi = glm::max(t0, t1);
        if (std::max({lo.x, lo.y, lo.z, 0.0f}) > std::min({hi.x, hi.y, hi.z, 1.0f})) continue;
        if (box.count == 0) {
            stack.push_back(index + 1);
            stack.push_back(box.right);
            continue;
        }
        for (size_t i = box.first; i < box.first + box.count; ++i) {  // Moeller-Trumbore
            const Triangle& t = triangles_[i];
            const vec3 e1 = t.b - t.a, e2 = t.c - t.a, p = glm::cross(d, e2);
            const float determinant = glm::dot(e1, p);
            if (std::abs(determinant) < 1e-12f) continue;
            const vec3 s = a - t.a, q = glm::cross(s, e1);
            const float u = glm::dot(s, p) / determinant, v = glm::dot(d, q) / determinant,
                        w = glm::dot(e2, q) / determinant;
            if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f && w > 1e-4f && w < 1.0f - 1e-4f) return true;
        }
    }
    return false;
}

float RayScene::distance(vec3 p, float limit) const {
    float best = limit * limit;
    std::vector<size_t> stack{0};
    while (!stack.empty()) {
        const size_t index = stack.back();
        stack.pop_back();
        const Box& box = boxes_[index];
        const vec3 d = p - glm::clamp(p, box.low, box.high);
        if (glm::dot(d, d) >= best) continue;
        if (box.count == 0) {
            stack.push_back(index + 1);
            stack.push_back(box.right);
        }
        for (size_t i = box.first; i < box.first + box.count; ++i) {
            best = std::min(best, distance_squared(p, triangles_[i].a, triangles_[i].b, triangles_[i].c));
        }
    }
    return std::sqrt(best);
}

}  // namespace tyndall::level
