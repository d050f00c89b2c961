#include "engine/platform/frame_clock.h"

#include <algorithm>

namespace tyndall {

double FrameClock::tick() {
    double step = fixed_;
    if (fixed_ == 0) {
        const auto now = std::chrono::steady_clock::now();
        const bool first = last_ == std::chrono::steady_clock::time_point{};
        step = first ? 0.0 : std::min(std::chrono::duration<double>(now - last_).count(), longest_step);
        last_ = now;
    }
    time_ += step;
    return step;
}

}  // namespace tyndall
