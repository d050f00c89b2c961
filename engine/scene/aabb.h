#pragma once

#include <glm/glm.hpp>

namespace tyndall {

struct Aabb {
    glm::vec3 min{1e30f}, max{-1e30f};
    void add(glm::vec3 p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    [[nodiscard]] bool empty() const { return min.x > max.x; }
};
[[nodiscard]] Aabb transformed(const Aabb& box, const glm::mat4& m);

}  // namespace tyndall
