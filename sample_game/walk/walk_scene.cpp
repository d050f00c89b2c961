#include "sample_game/walk/walk_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <utility>

#include "engine/core/error.h"

namespace tyndall {
namespace {

constexpr float flame_speed = 12;                   // m/s, from the first lamp of a place to the others
constexpr double kindling = 0.9;                    // s in which a lamp comes to its light
constexpr float pilot = 0.2f, shown_pilot = 0.5f;   // shares of its light: a first lamp that waits
constexpr double pilot_period = 2.6;                // s
constexpr float glow_distance = 0.8f;               // m, from a lamp to the middle of what glows with it
constexpr double fog_seconds = 8;                   // in which fog rises or falls
constexpr glm::vec3 in_hand{0.45f, -0.55f, -0.3f};  // m, of the eye: right, up, back
constexpr float lantern_radius = 0.05f;

glm::vec3 position(const Scene& scene, const Light& light) {
    return glm::vec3(scene.nodes[static_cast<std::size_t>(light.node)].world[3]);
}

bool glows(const Scene& scene, int mesh) {
    const int material = scene.meshes[static_cast<std::size_t>(mesh)].material;
    return scene.materials[static_cast<std::size_t>(material)].emissive != glm::vec3(0);
}

/// A mesh without its light, made once.
int dark_twin(Scene& scene, int mesh, std::map<int, int>& twins) {
    if (!glows(scene, mesh)) return mesh;
    const auto [entry, added] = twins.try_emplace(mesh, static_cast<int>(scene.meshes.size()));
    if (added) {
        Mesh twin = scene.meshes[static_cast<std::size_t>(mesh)];
        Material material = scene.materials[static_cast<std::size_t>(twin.material)];
        material.emissive = glm::vec3(0);
        material.base_color *= glm::vec4(glm::vec3(0.35f), 1);
        twin.material = static_cast<int>(scene.materials.size());
        scene.materials.push_back(std::move(material));
        scene.meshes.push_back(std::move(twin));
    }
    return entry->second;
}

void show(Scene& scene, const std::vector<int>& nodes, bool on) {
    for (const int node : nodes) scene.nodes[static_cast<std::size_t>(node)].scale = glm::vec3(on ? 1.0f : 0.0f);
}

}  // namespace

WalkScene::WalkScene(WalkScript script, Scene& scene, const std::string& where)
    : script_(std::move(script)), media_(scene.media), exposure_(scene.exposure_ev100) {
    for (std::size_t i = 0; i < script_.places.size(); ++i)
        for (const WalkScript::Fog& fog : script_.places[i].fog)
            if (fog.medium >= media_.size())
                throw Error(fmt::format("{}.places[{}]: medium {} given, but the scene has {}", where, i,
                                        fog.medium, media_.size()));
    if (const auto sun = scene.sun()) sun_ = {*sun, scene.lights[*sun].intensity};
    gather_lamps(scene, where);
    add_twins(scene);
    for (const Lamp& lamp : lamps_) shine(scene, lamp, 1, true);
    lantern_ = scene.lights.size();
    Node hand;
    hand.name = "lantern in hand";
    scene.lights.push_back({.name = "lantern",
                            .intensity = glm::vec3(0),
                            .range = script_.lantern.range,
                            .radius = lantern_radius,
                            .node = static_cast<int>(scene.nodes.size())});
    scene.nodes.push_back(std::move(hand));
    update_world_transforms(scene);
}

void WalkScene::gather_lamps(const Scene& scene, const std::string& where) {
    for (std::size_t p = 0; p < script_.places.size(); ++p) {
        const WalkScript::Place& place = script_.places[p];
        const std::size_t before = lamps_.size();
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            const Light& light = scene.lights[i];
            if (light.type == LightType::sun || light.node < 0) continue;
            const glm::vec3 at = position(scene, light);
            const bool taken = std::ranges::find(lamps_, i, &Lamp::light) != lamps_.end();
            if (!taken && glm::clamp(at, place.lamps.min, place.lamps.max) == at)
                lamps_.push_back({i, light.intensity, p, glm::distance(at, place.at) / flame_speed, false, {}, {}});
        }
        if (lamps_.size() == before)
            throw Error(fmt::format("{}.places[{}].lamps: no lamp of the scene is in it", where, p));
        std::ranges::min_element(lamps_.begin() + static_cast<std::ptrdiff_t>(before), lamps_.end(), {},
                                 &Lamp::delay)
            ->first = true;
    }
}

WalkScene::Lamp* WalkScene::lamp_at(const Scene& scene, glm::vec3 middle) {
    const auto distance = [&](const Lamp& lamp) {
        return glm::distance(position(scene, scene.lights[lamp.light]), middle);
    };
    const auto nearest = std::ranges::min_element(lamps_, {}, distance);
    return distance(*nearest) < glow_distance ? &*nearest : nullptr;
}

void WalkScene::add_twins(Scene& scene) {
    std::map<int, int> twins;
    const auto count = static_cast<int>(scene.nodes.size());
    for (int n = 0; n < count; ++n) {
        const Node node = scene.nodes[static_cast<std::size_t>(n)];
        const auto glowing = std::ranges::find_if(node.meshes, [&](int mesh) { return glows(scene, mesh); });
        if (node.cast_shadow || glowing == node.meshes.end()) continue;
        const Aabb& box = scene.meshes[static_cast<std::size_t>(*glowing)].bounds;
        Lamp* lamp = lamp_at(scene, glm::vec3(node.world * glm::vec4((box.min + box.max) * 0.5f, 1)));
        if (lamp == nullptr) continue;
        const auto add = [&](std::vector<int>& nodes, std::vector<int> meshes) {
            nodes.push_back(static_cast<int>(scene.nodes.size()));
            scene.nodes.push_back({.name = node.name,
                                   .parent = n,
                                   .meshes = std::move(meshes),
                                   .cast_shadow = false,
                                   .draw_distance = node.draw_distance,
                                   .dynamic = true});
        };
        std::vector<int> dark;
        for (const int mesh : node.meshes) dark.push_back(dark_twin(scene, mesh, twins));
        add(lamp->glowing, node.meshes);
        add(lamp->dark, std::move(dark));
        scene.nodes[static_cast<std::size_t>(n)].meshes.clear();
    }
}

void WalkScene::shine(Scene& scene, const Lamp& lamp, float brightness, bool glows) {
    scene.lights[lamp.light].intensity = lamp.intensity * brightness;
    show(scene, lamp.glowing, glows);
    show(scene, lamp.dark, !glows);
}

void WalkScene::apply(Scene& scene, const Walk& walk, const glm::mat4& eye_to_world, double time) const {
    const float breath = 0.65f + 0.35f * static_cast<float>(std::sin(time * glm::two_pi<double>() / pilot_period));
    for (const Lamp& lamp : lamps_) {
        const std::optional<double> burning = walk.burning(lamp.place);
        float brightness = burning ? smooth_share((*burning - static_cast<double>(lamp.delay)) / kindling) : 0.0f;
        if (!burning && lamp.first) brightness = breath * (walk.is_lost() ? shown_pilot : pilot);
        shine(scene, lamp, brightness, brightness > 0);
    }
    for (std::size_t p = 0; p < script_.places.size(); ++p)
        for (const WalkScript::Fog& fog : script_.places[p].fog) {
            const float share = glm::mix(fog.before, 1.0f, smooth_share(walk.burning(p).value_or(0) / fog_seconds));
            const Medium& own = media_[fog.medium];
            Medium& medium = scene.media[fog.medium];
            medium.sigma_s = own.sigma_s * share;
            medium.sigma_a = own.sigma_a * share;
            medium.emission = own.emission * share;
        }
    const float evening = walk.evening();
    const WalkScript::Night& night = script_.night;
    if (sun_)
        scene.lights[sun_->light].intensity =
            sun_->intensity * std::pow(night.sun, evening) * glm::mix(glm::vec3(1), night.color, evening);
    scene.exposure_ev100 = exposure_ + evening * night.exposure;
    Light& lantern = scene.lights[lantern_];
    const bool carried = walk.lantern() && !walk.ending();
    lantern.intensity = carried ? script_.lantern.candela * script_.lantern.color : glm::vec3(0);
    scene.nodes[static_cast<std::size_t>(lantern.node)].translation =
        glm::vec3(eye_to_world * glm::vec4(in_hand, 1));
    update_world_transforms(scene);
}

void WalkScene::restore(Scene& scene) const {
    for (const Lamp& lamp : lamps_) shine(scene, lamp, 1, true);
    scene.media = media_;
    if (sun_) scene.lights[sun_->light].intensity = sun_->intensity;
    scene.exposure_ev100 = exposure_;
    scene.lights[lantern_].intensity = glm::vec3(0);
    update_world_transforms(scene);
}

}  // namespace tyndall
