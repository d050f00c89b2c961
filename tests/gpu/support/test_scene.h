#pragma once

#include <glm/glm.hpp>

#include "engine/scene/scene.h"

namespace tyndall::test {

/// Builds small scenes in memory; call finish() when all is added.
class SceneBuilder {
  public:
    SceneBuilder();
    int material(glm::vec3 base_color, float roughness = 1, float metallic = 0, glm::vec3 emissive = glm::vec3(0));
    /// A square in the plane of x and z around `center`, facing +Y.
    void ground(glm::vec3 center, float half_size, int material = 0);
    void box(glm::vec3 center, glm::vec3 half_size, int material = 0);
    void sphere(glm::vec3 center, float radius, int material = 0);
    /// Shines along `direction`.
    void sun(glm::vec3 direction, glm::vec3 lux, bool shadow = true);
    Light& point(glm::vec3 position, glm::vec3 candela, float range, bool shadow = false);
    Light& spot(glm::vec3 position, glm::vec3 direction, glm::vec3 candela, float range, float outer_cone,
                bool shadow = false);
    Scene& finish();
    Scene scene;

  private:
    int node(const glm::mat4& world);
    void place(Mesh mesh, glm::vec3 center);
};

/// The matrix that moves -Z to `direction` and the origin to `position`.
[[nodiscard]] glm::mat4 pose(glm::vec3 position, glm::vec3 direction);

}  // namespace tyndall::test
