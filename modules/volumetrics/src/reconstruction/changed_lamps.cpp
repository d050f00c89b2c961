#include "reconstruction/changed_lamps.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace tyndall::volumetrics {
namespace {

constexpr float unlimited = 1e6F;  ///< m, of a lamp without a range
constexpr float one_frame = 0.1F;  ///< m
constexpr float same_lamp = 2.0F;  ///< m: farther, one came and another went

auto key(const Lamp& lamp) {
    return std::tuple(lamp.position.x, lamp.position.y, lamp.position.z, lamp.range, lamp.axis.x, lamp.axis.y,
                      lamp.axis.z, lamp.cos_outer);
}

bool less(const Lamp& a, const Lamp& b) {
    return key(a) < key(b);
}

std::vector<Lamp> without(const std::vector<Lamp>& all, const std::vector<Lamp>& others) {
    std::vector<Lamp> rest;
    std::ranges::set_difference(all, others, std::back_inserter(rest), less);
    return rest;
}

float range(const Lamp& lamp) {
    return lamp.range > 0 ? lamp.range : unlimited;
}

/// m, of what it lights.
float movement(const Lamp& a, const Lamp& b) {
    if (a.range != b.range || a.cos_outer != b.cos_outer) return unlimited;
    return glm::distance(a.position, b.position) + 0.5F * range(a) * glm::distance(a.axis, b.axis);
}

}  // namespace

std::vector<ChangedLamp> changed_lamps(const std::vector<Lamp>& before, const std::vector<Lamp>& now) {
    std::vector<Lamp> sorted_before = before, sorted_now = now;
    std::ranges::sort(sorted_before, less);
    std::ranges::sort(sorted_now, less);
    std::vector<Lamp> gone = without(sorted_before, sorted_now);
    std::vector<ChangedLamp> changed;
    for (const Lamp& lamp : without(sorted_now, sorted_before)) {
        const auto nearest =
            std::ranges::min_element(gone, {}, [&](const Lamp& old) { return movement(lamp, old); });
        float frames = 1;
        if (nearest != gone.end() && movement(lamp, *nearest) < same_lamp) {
            frames = std::max(one_frame / movement(lamp, *nearest), 1.0F);
            changed.push_back({nearest->position, range(*nearest), frames});
            gone.erase(nearest);
        }
        changed.push_back({lamp.position, range(lamp), frames});
    }
    for (const Lamp& lamp : gone) changed.push_back({lamp.position, range(lamp), 1});
    return changed;
}

}  // namespace tyndall::volumetrics
