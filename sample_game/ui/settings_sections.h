#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "volumetrics/technique.h"

namespace tyndall {

/// Rows of volumetrics::settings_table() that the settings panel shows together under a heading.
struct SettingsSection {
    std::string title;
    std::vector<std::string> prefixes;  ///< of its rows' keys
    std::string summary;                ///< key of the row whose value stands in the heading; empty: none
    std::function<bool(const volumetrics::TechniqueDesc&)> matters;  ///< the technique reads these settings
    std::string own;  ///< the technique that it is all about, open at first; empty: none
};

/// In the panel's order. Rows that belong to none come before them.
[[nodiscard]] const std::vector<SettingsSection>& settings_sections();
/// Null: none.
[[nodiscard]] const SettingsSection* section_of(std::string_view key);
/// Whether the panel shows the section while `technique` is chosen.
[[nodiscard]] bool matters(const SettingsSection& section, const std::string& technique);

}  // namespace tyndall
