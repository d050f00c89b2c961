#pragma once

#include "engine/core/settings.h"

namespace tyndall {

/// A widget per row of every settings table: slider, combo or check box, with help and unit as a tooltip and a
/// reset by right click.
void settings_panel(SettingsSet& settings);

}  // namespace tyndall
