#include "engine/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace tyndall {
namespace {

template <class T>
const T* find_named(const std::vector<T>& items, const std::string& name) {
    const auto found = std::ranges::find(items, name, &T::name);
    return found == items.end() ? nullptr : &*found;
}

int add_node(Scene& scene, const std::string& name, glm::vec3 position, glm::vec3 direction) {
    Node node;
    node.name = name;
    node.translation = position;
    node.rotation = glm::quatLookAt(direction, glm::vec3(0, 1, 0));
    node.world = glm::translate(glm::mat4(1), position) * glm::mat4_cast(node.rotation);
    scene.nodes.push_back(node);
    return static_cast<int>(scene.nodes.size()) - 1;
}

}  // namespace

const Camera* Scene::find_camera(const std::string& name) const {
    if (const Camera* camera = find_named(cameras, name)) return camera;
    const auto by_node = std::ranges::find_if(cameras, [&](const Camera& c) {
        return c.node >= 0 && nodes[static_cast<std::size_t>(c.node)].name == name;
    });
    return by_node == cameras.end() ? nullptr : &*by_node;
}

const Animation* Scene::find_animation(const std::string& name) const {
    return find_named(animations, name);
}

const Node* Scene::find_node(const std::string& name) const {
    return find_named(nodes, name);
}

std::vector<std::size_t> Scene::suns() const {
    const auto luminance = [this](std::size_t i) {
        return glm::dot(lights[i].intensity, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    };
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (lights[i].type == LightType::sun && lights[i].node >= 0 && luminance(i) > 0) found.push_back(i);
    std::ranges::stable_sort(found, std::greater(), luminance);
    return found;
}

float Scene::light_unit() const {
    return std::exp2(std::clamp(std::round(exposure_ev100), -10.0f, 50.0f));
}

std::optional<std::size_t> Scene::sun() const {
    const std::vector<std::size_t> all = suns();
    return all.empty() ? std::nullopt : std::optional(all.front());
}

void add_missing_sun(Scene& scene) {
    if (scene.lights.empty()) {
        Light light;
        light.name = "default sun";
        light.type = LightType::sun;
        // A white diffuse surface that faces it has the luminance that exposure shows as 1/1.2.
        light.intensity = glm::vec3(std::numbers::pi_v<float> * std::exp2(scene.exposure_ev100));
        light.node = add_node(scene, light.name, glm::vec3(0), glm::normalize(glm::vec3(-0.5f, -1.0f, -0.7f)));
        scene.nodes.back().light = static_cast<int>(scene.lights.size());
        scene.lights.push_back(light);
    }
}

void add_missing_camera(Scene& scene) {
    if (scene.cameras.empty()) {
        const bool empty = scene.bounds.empty();
        const glm::vec3 center = empty ? glm::vec3(0) : (scene.bounds.min + scene.bounds.max) * 0.5f;
        const float radius = empty ? 1.0f : std::max(glm::distance(scene.bounds.max, center), 1e-3f);
        Camera camera;
        camera.name = "default";
        camera.yfov = 0.8f;
        camera.znear = std::min(0.1f, radius * 0.02f);
        const glm::vec3 direction = glm::normalize(glm::vec3(-0.5f, -0.4f, -1.0f));
        const float distance = radius / std::sin(camera.yfov * 0.5f);
        camera.node = add_node(scene, camera.name, center - direction * distance, direction);
        scene.nodes.back().camera = static_cast<int>(scene.cameras.size());
        scene.cameras.push_back(camera);
    }
}

}  // namespace tyndall
