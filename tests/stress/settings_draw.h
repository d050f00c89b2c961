#pragma once

#include "frame.h"
#include "random.h"

namespace tyndall::stress {

/// Gives every setting of the table that has this effect a random value: whatever rows the table gets, they are
/// drawn. Extremes are frequent; large resources are rare, because they cost time.
void draw_settings(const SettingsTable& table, void* object, SettingEffect effect, const Random& random);

/// Lowers what would take seconds: froxels, clusters.
void limit_resources(StressOptions& options);

}  // namespace tyndall::stress
