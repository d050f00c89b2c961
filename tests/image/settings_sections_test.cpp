// Where the settings panel shows which row.
#include "sample_game/ui/settings_sections.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "volumetrics/settings.h"

namespace tyndall {
namespace {

TEST(SettingsSections, EveryRowButTheTechniqueIsInOne) {
    for (const Setting& s : volumetrics::settings_table().settings()) {
        std::size_t sections = 0;
        for (const SettingsSection& section : settings_sections())
            sections += std::ranges::any_of(section.prefixes, [&](const auto& p) { return s.key.starts_with(p); });
        EXPECT_EQ(sections, s.key == "technique" ? 0U : 1U) << s.key;
    }
}

TEST(SettingsSections, EveryPrefixAndSummaryIsThatOfARow) {
    const std::vector<Setting>& rows = volumetrics::settings_table().settings();
    for (const SettingsSection& section : settings_sections()) {
        for (const std::string& prefix : section.prefixes)
            EXPECT_TRUE(std::ranges::any_of(rows, [&](const Setting& s) { return s.key.starts_with(prefix); }))
                << prefix;
        EXPECT_TRUE(section.summary.empty() || section_of(section.summary) == &section) << section.title;
    }
}

TEST(SettingsSections, ATechniqueShowsItsOwnAndNotThoseOfOthers) {
    for (const std::string& technique : volumetrics::technique_names()) {
        const auto own = std::ranges::count_if(settings_sections(), [&](const SettingsSection& s) {
            return s.own == technique && matters(s, technique);
        });
        EXPECT_EQ(own, technique == "off" ? 0 : 1) << technique;
        EXPECT_NE(volumetrics::technique(technique).help, "") << technique;
    }
    EXPECT_TRUE(matters(*section_of("noise_size"), "ray_march"));
    EXPECT_FALSE(matters(*section_of("noise_size"), "froxel"));
    EXPECT_FALSE(matters(*section_of("particle_size"), "ray_march"));
    EXPECT_TRUE(matters(*section_of("froxels_x"), "ray_march"));
    EXPECT_FALSE(matters(*section_of("froxels_x"), "off"));
    EXPECT_EQ(section_of("technique"), nullptr);
}

}  // namespace
}  // namespace tyndall
