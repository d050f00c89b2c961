#include "light/few_lamps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tyndall::volumetrics {
namespace {

constexpr float narrow_cosine = 0.7F;  // of 45 degrees

bool has_sharp_edges(const Lamp& lamp) {
    return lamp.shadow || lamp.cos_outer > narrow_cosine;
}

}  // namespace

std::vector<Lamp> choose_few_lamps(const std::vector<Lamp>& lamps, glm::vec3 eye, float sigma_t, int most,
                                   float least) {
    std::vector<float> light(lamps.size());
    std::ranges::transform(lamps, light.begin(), [&](const Lamp& lamp) {
        const float distance = glm::distance(eye, lamp.position);
        const float part = lamp.range > 0 ? std::min(1.0F, lamp.range / std::max(distance, 1e-6F)) : 1.0F;
        return part * lamp.intensity / std::max(distance, 1.0F) * std::exp(-sigma_t * distance);
    });
    const float total = std::accumulate(light.begin(), light.end(), 0.0F);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < lamps.size(); ++i)
        if (has_sharp_edges(lamps[i]) && light[i] > least * total) chosen.push_back(i);
    std::ranges::stable_sort(chosen, [&](std::size_t a, std::size_t b) { return light[a] > light[b]; });
    chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(most)));
    std::ranges::sort(chosen);
    std::vector<Lamp> few;
    for (const std::size_t i : chosen) few.push_back(lamps[i]);
    return few;
}

}  // namespace tyndall::volumetrics
