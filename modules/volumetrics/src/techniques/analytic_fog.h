#pragma once

#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

/// The technique analytic_fog, at the host's resolution.
[[nodiscard]] Estimate add_analytic_fog(Frame& frame);

}  // namespace tyndall::volumetrics
