#include "sample_game/level_logic.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/scene/data_root.h"

namespace tyndall {
namespace {

/// Of molecules, by Rayleigh's law, at 680, 550 and 440 nm (Bruneton and Neyret 2008), thinning by e in 8 km.
Medium clear_air(float scale) {
    Medium air;
    air.shape = Medium::Shape::height;
    air.sigma_s = scale * glm::vec3(5.8e-6f, 13.5e-6f, 33.1e-6f);
    air.rayleigh = true;
    air.height_profile = true;
    air.falloff = 8000 / scale;
    return air;
}

}  // namespace

LevelLogic::LevelLogic(const Scene& scene)
    : media_(scene.media), sun_index_(scene.sun()), exposure_(scene.exposure_ev100) {
    if (sun_index_) {
        sun_ = scene.lights[*sun_index_];
        if (sun_.node >= 0) sun_rotation_ = scene.nodes[sun_.node].rotation;
        day_times_ = {{"as made", 0, 0, glm::vec3(1), 0, exposure_},
                      {"dawn", 6, 150, {1.0f, 0.62f, 0.42f}, 400, exposure_ - 0.5f},
                      {"morning", 28, 100, {1.0f, 0.9f, 0.76f}, 3500, exposure_ + 2.5f},
                      {"noon", 62, 40, {1.0f, 0.97f, 0.92f}, 9000, exposure_ + 4.0f},
                      {"night", 35, -60, {0.55f, 0.68f, 1.0f}, 12, exposure_ - 2.0f}};
    } else {
        day_times_ = {{"as made", 0, 0, glm::vec3(1), 0, exposure_}};
    }
    fogs_ = {{"as made", 1.0f},
             {"none", 0.0f},
             {"thin", 0.35f},
             {"thick", 2.5f},
             // A level is a few hundred metres wide: as if it were kilometres.
             {"blue air", 0.0f, 50},
             {"clouds", 1.0f, 0, "assets/grids/clouds.json"}};
}

void LevelLogic::set_day_time(Scene& scene, std::size_t index) {
    day_time_ = index;
    if (!sun_index_) return;
    Light& light = scene.lights[*sun_index_];
    Node& node = scene.nodes[light.node];
    const DayTime& t = day_times_[index];
    scene.exposure_ev100 = t.exposure_ev100;
    if (index == 0) {
        light = sun_;
        node.rotation = sun_rotation_;
    } else {
        // The node's -Z is the way sunlight travels: keep the level's own azimuth as the origin of the turn.
        const glm::vec3 own = sun_rotation_ * glm::vec3(0, 0, -1);
        const float azimuth = std::atan2(-own.x, -own.z) + glm::radians(t.azimuth);
        node.rotation = glm::angleAxis(azimuth, glm::vec3(0, 1, 0)) *
                        glm::angleAxis(-glm::radians(t.elevation), glm::vec3(1, 0, 0));
        light.intensity = t.color * t.illuminance;
    }
    update_world_transforms(scene);
}

void LevelLogic::set_fog(Scene& scene, std::size_t index) {
    fog_ = index;
    const float factor = fogs_[index].factor;
    scene.media.clear();
    if (factor > 0) scene.media = media_;
    for (Medium& medium : scene.media) {
        medium.sigma_s *= factor;
        medium.sigma_a *= factor;
        medium.emission *= factor;
    }
    if (!fogs_[index].added.empty())
        std::ranges::move(load_media(data_root() / fogs_[index].added), std::back_inserter(scene.media));
    if (fogs_[index].air > 0) scene.media.push_back(clear_air(fogs_[index].air));
}

}  // namespace tyndall
