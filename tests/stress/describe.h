#pragma once

#include <string>

#include "frame.h"

namespace tyndall::stress {

/// The lights, media, camera and settings of a frame in words, for whoever looks into a failure.
[[nodiscard]] std::string describe(const StressFrame& frame);

}  // namespace tyndall::stress
