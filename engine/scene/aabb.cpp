#include "engine/scene/aabb.h"

namespace tyndall {

// Every corner's coordinate is a sum of one of two products per axis: the smaller ones make the minimum, the larger
// ones the maximum.
Aabb transformed(const Aabb& box, const glm::mat4& m) {
    if (box.empty()) return box;
    Aabb out{glm::vec3(m[3]), glm::vec3(m[3])};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3 a = glm::vec3(m[axis]) * box.min[axis];
        const glm::vec3 b = glm::vec3(m[axis]) * box.max[axis];
        out.min += glm::min(a, b);
        out.max += glm::max(a, b);
    }
    return out;
}

}  // namespace tyndall
