#include "sample_game/ui/settings_sections.h"

#include <algorithm>
#include <cctype>

namespace tyndall {
namespace {

using volumetrics::Sampling;
using volumetrics::TechniqueDesc;

bool any(const TechniqueDesc&) {
    return true;
}
bool samples(const TechniqueDesc& technique) {
    return technique.traits.sampling != Sampling::exact;
}
bool has_resolution(const TechniqueDesc& technique) {
    return technique.traits.any_resolution;
}

/// "Ray march" of "ray_march".
std::string title_of(std::string name) {
    std::ranges::replace(name, '_', ' ');
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

std::vector<SettingsSection> make_sections() {
    std::vector<SettingsSection> sections;
    for (const std::string& name : volumetrics::technique_names()) {
        const TechniqueDesc& technique = volumetrics::technique(name);
        if (technique.settings.empty()) continue;
        SettingsSection own{title_of(name), {technique.settings}, "", {}, name};
        // Froxels are what local media and transparents are drawn with, whatever the technique.
        if (name == "froxel")
            own.matters = any;
        else
            own.matters = [name](const TechniqueDesc& chosen) { return chosen.name == name; };
        sections.push_back(std::move(own));
    }
    sections.push_back({"Noise", {"noise", "fast_"}, "noise", samples, ""});
    sections.push_back({"Spatial filter", {"filter", "reconstruct"}, "filter", has_resolution, ""});
    sections.push_back({"Resolution", {"resolution", "upsample"}, "resolution", has_resolution, ""});
    sections.push_back({"Temporal filter", {"temporal"}, "temporal", has_resolution, ""});
    sections.push_back({"Light",
                        {"max_distance", "grid_piece", "lamp_integration", "light_transmittance", "phase",
                         "sky_steps", "scattering_orders"},
                        "",
                        any,
                        ""});
    sections.push_back({"Light volumes", {"sun_volume_", "grid_volume_", "lamp_volume_"}, "", any, ""});
    return sections;
}

}  // namespace

const std::vector<SettingsSection>& settings_sections() {
    static const std::vector<SettingsSection> sections = make_sections();
    return sections;
}

const SettingsSection* section_of(std::string_view key) {
    for (const SettingsSection& section : settings_sections())
        if (std::ranges::any_of(section.prefixes, [&](const std::string& p) { return key.starts_with(p); }))
            return &section;
    return nullptr;
}

bool matters(const SettingsSection& section, const std::string& technique) {
    const TechniqueDesc& chosen = volumetrics::technique(technique);
    return chosen.add && section.matters(chosen);
}

}  // namespace tyndall
