#include "bench/scene_edit.h"

#include <cmath>

namespace tyndall::bench {
namespace {

Medium sphere(int index, const View& view) {
    // phi_3 = 1.2207… solves x^4 = x + 1; powers of its inverse fill a cube evenly. M. Roberts 2018.
    const glm::dvec3 step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    const glm::dvec3 u = glm::fract(0.5 + step * static_cast<double>(index + 1));
    const double depth = 3 * std::pow(10.0, u.z);
    const double half_height = depth * std::tan(view.yfov / 2);
    const glm::dvec4 in_view{(2 * u.x - 1) * half_height * view.aspect, (2 * u.y - 1) * half_height, -depth, 1};
    Medium medium;
    medium.shape = Medium::Shape::sphere;
    medium.center = glm::vec3(glm::inverse(glm::dmat4(view.view)) * in_view);
    medium.half_extent = glm::vec3(0.5f);
    medium.softness = 0.25f;
    medium.sigma_s = glm::vec3(0.5f);
    return medium;
}

}  // namespace

void SceneEditor::apply(Scene& scene, const View& view, const SceneEdit& edit) const {
    scene.lights = lights_;
    scene.media = media_;
    if (edit.lamps >= 0) {
        int kept = 0;
        for (Light& light : scene.lights)
            if (light.type != LightType::sun && kept++ >= edit.lamps) light.intensity = glm::vec3(0);
    }
    if (edit.spheres < 0) return;
    scene.media.clear();
    for (int i = 0; i < edit.spheres; ++i) scene.media.push_back(sphere(i, view));
}

}  // namespace tyndall::bench
