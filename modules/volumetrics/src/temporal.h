#pragma once

#include "engine/graph/history.h"
#include "passes.h"

namespace tyndall::volumetrics {

/// What the setting `temporal` keeps from frame to frame.
class TemporalHistory {
  public:
    /// A frame without a history: frees it.
    void release() { *this = TemporalHistory(); }
    [[nodiscard]] std::size_t bytes() const { return 0; }
};

}  // namespace tyndall::volumetrics
