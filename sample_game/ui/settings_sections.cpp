#include "sample_game/ui/settings_sections.h"

#include <algorithm>

namespace tyndall {

const std::vector<SettingsSection>& settings_sections() {
    using enum volumetrics::Technique;
    static const std::vector<volumetrics::Technique> noisy{ray_march, billboards, particles, shaft_geometry,
                                                           radial_shafts};
    static const std::vector<volumetrics::Technique> sampled{ray_march, froxel,         billboards,
                                                             particles, shaft_geometry, radial_shafts};
    static const std::vector<SettingsSection> sections{
        {"Ray march", {"steps", "stepping"}, "", {ray_march}, ray_march},
        {"Billboards", {"billboard_"}, "", {billboards}, billboards},
        {"Particles", {"particle_"}, "", {particles}, particles},
        {"Shaft geometry", {"shaft_"}, "", {shaft_geometry}, shaft_geometry},
        {"Analytic fog", {"fog_mode"}, "", {analytic_fog}, analytic_fog},
        {"Radial shafts", {"radial_"}, "", {radial_shafts}, radial_shafts},
        {"Reference", {"reference_"}, "", {reference}, reference},
        {"Froxels", {"froxel"}, "", {}, froxel},
        {"Noise", {"noise", "fast_"}, "noise", noisy, {}},
        {"Spatial filter", {"filter", "reconstruct"}, "filter", sampled, {}},
        {"Resolution", {"resolution", "upsample"}, "resolution", sampled, {}},
        {"Temporal filter", {"temporal"}, "temporal", sampled, {}},
        {"Light", {"max_distance", "lamp_integration", "light_transmittance", "phase"}, "", {}, {}},
        {"Light volumes", {"sun_volume_", "lamp_volume_"}, "", {}, {}},
    };
    return sections;
}

const SettingsSection* section_of(std::string_view key) {
    for (const SettingsSection& section : settings_sections())
        if (std::ranges::any_of(section.prefixes, [&](const std::string& p) { return key.starts_with(p); }))
            return &section;
    return nullptr;
}

bool matters(const SettingsSection& section, volumetrics::Technique technique) {
    if (technique == volumetrics::Technique::off) return false;
    return section.techniques.empty() || std::ranges::count(section.techniques, technique) > 0;
}

}  // namespace tyndall
