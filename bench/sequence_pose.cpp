#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "bench/sequences.h"
#include "session/scene_options.h"

namespace tyndall::bench {
namespace {

constexpr float stride = 0.05f;             ///< m per frame
constexpr float turn = glm::radians(0.5f);  ///< per frame
const glm::vec3 up(0, 1, 0);

/// Moved by `offset`, then turned round the vertical through its origin.
glm::mat4 moved(const glm::mat4& world, glm::vec3 offset, float angle) {
    const glm::vec3 at = glm::vec3(world[3]) + offset;
    glm::mat4 rotation = glm::rotate(glm::mat4(1), angle, up) * world;
    rotation[3] = glm::vec4(at, 1);
    return rotation;
}

}  // namespace

std::string Pose::name() const {
    return *this == Pose{} ? "" : fmt::format("-camera{}-light{}", camera, light);
}

View pose(Scene& scene, const Place& place, glm::ivec2 size, const Pose& pose) {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    animate(scene, place.time);
    const View still = camera_view(scene, place.camera, aspect);
    const glm::mat4 camera = glm::inverse(still.view);
    const glm::vec3 right(camera[0]);
    if (pose.light != 0)
        for (const Light& light : scene.lights) {
            glm::mat4& world = scene.nodes[static_cast<std::size_t>(light.node)].world;
            world = moved(world, right * stride * float(pose.light), turn * float(pose.light));
        }
    if (pose.camera == 0) return still;
    return make_view(moved(camera, right * stride * float(pose.camera), turn * float(pose.camera)), still.yfov,
                     still.znear, aspect);
}

}  // namespace tyndall::bench
