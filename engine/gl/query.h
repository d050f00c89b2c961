#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/gl/handle.h"

namespace tyndall::gl {

/// Times named scopes on the GPU. On real drivers with timestamp queries read a few frames later, so nothing
/// stalls; in `finish` mode (software rasterisers, whose queries lie) with glFinish around every scope and the
/// wall clock.
enum class TimerMode { off, query, finish };

class GpuTimer {
  public:
    struct Scope {
        std::string name;
        double gpu_ms = 0;
        double cpu_ms = 0;
    };
    explicit GpuTimer(TimerMode mode = TimerMode::query);
    ~GpuTimer();
    GpuTimer(const GpuTimer&) = delete;
    GpuTimer& operator=(const GpuTimer&) = delete;

    void set_mode(TimerMode mode) { mode_ = mode; }
    [[nodiscard]] TimerMode mode() const { return mode_; }
    void begin_frame();
    void begin(const std::string& name);  ///< scopes do not nest
    void end();
    /// Waits for the frame just drawn and makes its times the results: for measurements, not for a game.
    const std::vector<Scope>& wait();
    /// Times of the last frame whose results have arrived, in the order of the scopes.
    [[nodiscard]] const std::vector<Scope>& results() const { return results_; }

  private:
    struct Frame;
    TimerMode mode_;
    std::vector<Frame> frames_;
    std::size_t current_ = 0;
    std::vector<Scope> results_;
};

}  // namespace tyndall::gl
