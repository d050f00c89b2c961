#pragma once

#include "engine/core/settings.h"

namespace tyndall {

/// A widget per row of every settings table: slider, combo or check box, with help and unit as a tooltip and a
/// reset by right click. Those of the volumetrics module in sections that fold (settings_sections.h), of which only
/// those that matter to the chosen technique are there. `show_acceptance`: VolumetricsAdapter.
void settings_panel(SettingsSet& settings, bool& show_acceptance);

/// The same for all rows of one table.
void settings_rows(const SettingsSet::Group& group);

}  // namespace tyndall
