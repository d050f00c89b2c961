#pragma once

#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// settings_table(): what registers a technique adds to its first row.
[[nodiscard]] SettingsTable& growing_settings_table();

}  // namespace tyndall::volumetrics
