#include "settings_draw.h"

#include <algorithm>
#include <cmath>

namespace tyndall::stress {
namespace {

/// Each choice has its own draw and the greatest wins: one choice more takes frames from the others and shifts none
/// among them (highest random weight, Thaler and Ravishankar 1998).
int draw_choice(const Setting& setting, const Random& random) {
    const auto weight = [&](const auto& choice) { return random.fork(choice).unit(); };
    const auto greatest = std::ranges::max_element(setting.choices, {}, weight);
    return static_cast<int>(greatest - setting.choices.begin());
}

double draw(const Setting& setting, Random random) {
    if (setting.type == SettingType::boolean) return random.below(2);
    if (setting.type == SettingType::choice) return draw_choice(setting, random);
    // Sides of shadow maps cost most by far.
    const bool resource = setting.effect == SettingEffect::resource, map = resource && setting.unit == "px";
    const double u = map ? std::pow(random.unit(), 16) : resource ? std::pow(random.unit(), 2) : random.unit();
    if (!setting.allowed.empty())
        return setting.allowed[static_cast<std::size_t>(u * static_cast<double>(setting.allowed.size()))];
    if (!resource && random.chance(0.1)) return setting.min;
    if (!resource && random.chance(0.1)) return setting.max;
    const bool logarithmic = setting.scale == SettingScale::logarithmic && setting.min > 0;
    const double value = logarithmic ? setting.min * std::pow(setting.max / setting.min, u)
                                     : setting.min + (setting.max - setting.min) * u;
    return setting.type == SettingType::integer ? std::round(value) : value;
}

void halve_until(int& a, int& b, int& c, long long most) {
    while (static_cast<long long>(a) * b * c > most) {
        int& largest = a >= b && a >= c ? a : b >= c ? b : c;
        largest = (largest + 1) / 2;
    }
}

}  // namespace

void draw_settings(const SettingsTable& table, void* object, SettingEffect effect, const Random& random) {
    for (const Setting& setting : table.settings())
        if (setting.effect == effect) setting.set(object, draw(setting, random.fork(setting.key)));
}

void limit_resources(StressOptions& options) {
    volumetrics::Settings& v = options.volumetrics;
    v.froxels.pixels = 0;  // the columns are drawn themselves
    halve_until(v.froxels.x, v.froxels.y, v.froxels.z, 100'000);
    for (int* side : {&v.froxels.x, &v.froxels.y, &v.froxels.z}) *side |= 1;  // see odd() in frame.cpp
    const auto at_most = [](int& value, int most) { value = std::min(value, most); };
    at_most(v.light_volumes.sun_size, 32);
    at_most(v.light_volumes.grid_size, 32);
    at_most(v.light_volumes.lamp_size, 12);
    at_most(v.particles.count, 4096);
    at_most(v.particles.local_count, 4096);
    at_most(v.billboards.layers, 32);
    at_most(v.shaft_geometry.grid, 96);
    RenderSettings& r = options.render;
    at_most(r.sky_directions, 24);
    at_most(r.sky_cells, 16);
    halve_until(r.cluster_x, r.cluster_y, r.cluster_z, 20'000);
}

}  // namespace tyndall::stress
