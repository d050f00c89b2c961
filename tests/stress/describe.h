#pragma once

#include <string>
#include <string_view>

#include "frame.h"

namespace tyndall::stress {

/// The lights, media, camera and settings of a frame in words, for whoever looks into a failure.
[[nodiscard]] std::string describe(const StressFrame& frame);

/// `condition` is KEY=VALUE with the key of a setting, or feature=NAME: a Feature of a comparable frame, or
/// extreme.
/// @throws Error if it is neither
[[nodiscard]] bool has(const StressFrame& frame, std::string_view condition);

}  // namespace tyndall::stress
