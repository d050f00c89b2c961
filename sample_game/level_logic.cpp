#include "sample_game/level_logic.h"

#include <cmath>

namespace tyndall {

LevelLogic::LevelLogic(const Scene& scene) : media_(scene.media), exposure_(scene.exposure_ev100) {
    const auto sun = scene.sun();
    if (sun) {
        sun_ = scene.lights[*sun];
        if (sun_.node >= 0) sun_rotation_ = scene.nodes[sun_.node].rotation;
        day_times_ = {{"as made", 0, 0, glm::vec3(1), 0, exposure_},
                      {"dawn", 6, 150, {1.0f, 0.62f, 0.42f}, 400, exposure_ - 0.5f},
                      {"morning", 28, 100, {1.0f, 0.9f, 0.76f}, 3500, exposure_ + 2.5f},
                      {"noon", 62, 40, {1.0f, 0.97f, 0.92f}, 9000, exposure_ + 4.0f},
                      {"night", 35, -60, {0.55f, 0.68f, 1.0f}, 12, exposure_ - 2.0f}};
    } else {
        day_times_ = {{"as made", 0, 0, glm::vec3(1), 0, exposure_}};
    }
    fogs_ = {{"as made", 1.0f}, {"none", 0.0f}, {"thin", 0.35f}, {"thick", 2.5f}};
}

void LevelLogic::set_day_time(Scene& scene, std::size_t index) {
    day_time_ = index;
    const auto sun = scene.sun();
    if (!sun || sun_.node < 0) return;
    Light& light = scene.lights[*sun];
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
    if (factor == 0) return;
    scene.media = media_;
    for (Medium& medium : scene.media) {
        medium.sigma_s *= factor;
        medium.sigma_a *= factor;
        medium.emission *= factor;
    }
}

}  // namespace tyndall
