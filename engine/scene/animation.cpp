#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/scene.h"

namespace tyndall {
namespace {

/// glm has quaternions as (w, x, y, z), glTF as xyzw. The shorter arc; linear and normalised where the arc is too
/// short for its sine to divide by.
glm::vec4 slerp(glm::vec4 a, glm::vec4 b, float u) {
    float cos_angle = glm::dot(a, b);
    if (cos_angle < 0) {
        b = -b;
        cos_angle = -cos_angle;
    }
    if (cos_angle > 0.9995f) return glm::normalize(glm::mix(a, b, u));
    const float angle = std::acos(cos_angle);
    return (a * std::sin((1 - u) * angle) + b * std::sin(u * angle)) / std::sin(angle);
}

/// glTF 2.0, appendix C.5: cubic Hermite spline. v value, b out-tangent of the left key, a in-tangent of the right
/// key (per second), span the seconds between them.
glm::vec4 hermite(glm::vec4 v0, glm::vec4 b0, glm::vec4 a1, glm::vec4 v1, float u, float span) {
    const float u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * v0 + span * (u3 - 2 * u2 + u) * b0 + (3 * u2 - 2 * u3) * v1 +
           span * (u3 - u2) * a1;
}

glm::vec4 evaluate(const Animation::Channel& channel, float time) {
    const bool cubic = channel.interpolation == Animation::Interpolation::cubic;
    const auto value = [&](std::size_t key) { return channel.values[cubic ? key * 3 + 1 : key]; };
    const auto& times = channel.times;
    const std::size_t right = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
    if (right == 0) return value(0);
    const std::size_t left = right - 1;
    if (right == times.size() || channel.interpolation == Animation::Interpolation::step) return value(left);

    const float span = times[right] - times[left];
    const float u = (time - times[left]) / span;
    const bool rotation = channel.path == Animation::Path::rotation;
    if (cubic) {
        const glm::vec4 v =
            hermite(value(left), channel.values[left * 3 + 2], channel.values[right * 3], value(right), u, span);
        if (!rotation) return v;
        return glm::length(v) > 1e-6f ? glm::normalize(v) : value(left);  // tangents may take it through zero
    }
    return rotation ? slerp(value(left), value(right), u) : glm::mix(value(left), value(right), u);
}

void apply(Scene& scene, const Animation& animation, float time) {
    for (const Animation::Channel& channel : animation.channels) {
        const glm::vec4 v = evaluate(channel, time);
        Node& node = scene.nodes[static_cast<std::size_t>(channel.node)];
        switch (channel.path) {
            case Animation::Path::translation:
                node.translation = glm::vec3(v);
                break;
            case Animation::Path::rotation:
                node.rotation = glm::quat(v.w, v.x, v.y, v.z);
                break;
            case Animation::Path::scale:
                node.scale = glm::vec3(v);
                break;
        }
    }
}

}  // namespace

void animate(Scene& scene, double time, const std::string& except) {
    for (const Animation& animation : scene.animations) {
        if (animation.name == except) continue;
        const double duration = animation.duration;
        const double looped = duration > 0 ? time - std::floor(time / duration) * duration : 0;
        apply(scene, animation, static_cast<float>(looped));
    }
    for (Medium& medium : scene.media)
        if (medium.shape == Medium::Shape::grid)
            medium.center = glm::vec3(glm::dvec3(medium.center_at_start) + time * glm::dvec3(medium.wind));
    update_world_transforms(scene);
}

void animate_one(Scene& scene, const Animation& animation, double time) {
    apply(scene, animation, static_cast<float>(std::clamp(time, 0.0, double(animation.duration))));
    update_world_transforms(scene);
}

void update_world_transforms(Scene& scene) {
    for (Node& node : scene.nodes) {
        glm::mat4 local = glm::mat4_cast(node.rotation);
        for (int axis = 0; axis < 3; ++axis) local[axis] *= node.scale[axis];
        local[3] = glm::vec4(node.translation, 1);
        node.world = node.parent < 0 ? local : scene.nodes[static_cast<std::size_t>(node.parent)].world * local;
    }
}

}  // namespace tyndall
