// Everything solid in the level as one list of triangles with a bounding volume hierarchy, for the checks.
#pragma once

#include "tools/level/level.h"

namespace tyndall::level {

class RayScene {
  public:
    // Triangles of all nodes, without alpha-masked foliage; with_lamps = false also leaves out what casts no
    // shadow.
    RayScene(const Level& level, const MaterialSet& materials, bool with_lamps);
    // True when something lies on the open segment between a and b.
    [[nodiscard]] bool blocked(vec3 a, vec3 b) const;
    // Distance from p to the nearest triangle, `limit` if none is nearer than that. Metres.
    [[nodiscard]] float distance(vec3 p, float limit) const;

  private:
    struct Triangle {
        vec3 a, b, c;
    };
    struct Box {
        vec3 low{1e30f}, high{-1e30f};
        size_t first = 0, count = 0;  // leaf where count > 0
        size_t right = 0;             // second child; the first follows its parent
    };
    size_t build(size_t first, size_t count);

    std::vector<Triangle> triangles_;
    std::vector<Box> boxes_;
};

}  // namespace tyndall::level
