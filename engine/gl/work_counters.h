#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/gl/buffer.h"

namespace tyndall::gl {

/// What instrumented shaders count, exactly and independently of the machine. Order matches
/// shaders/lib/work.glsl.
enum class Work {
    medium_samples,
    shadow_lookups,
    light_evaluations,
    texture_fetches,  ///< but those of density grids
    tree_nodes,
    grid_reads,        ///< values of density grids
    grid_light_reads,  ///< what is stored of what density grids leave of light
    grid_page_reads,   ///< words of their page table
    count
};
using WorkCounts = std::array<std::uint64_t, static_cast<int>(Work::count)>;
[[nodiscard]] const char* to_string(Work work);

/// Counters per pass for one frame. Shaders compiled with COUNT_WORK=1 add to the slot that `begin_pass` bound.
class WorkCounters {
  public:
    void begin_frame();
    void begin_pass(const std::string& name);  ///< binds this pass's slot at BINDING_WORK
    /// Waits for the GPU. Passes that counted nothing are left out.
    [[nodiscard]] std::vector<std::pair<std::string, WorkCounts>> read() const;

  private:
    Buffer buffer_;
    std::vector<std::string> passes_;
};

}  // namespace tyndall::gl
