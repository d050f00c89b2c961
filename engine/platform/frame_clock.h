#pragma once

#include <chrono>

namespace tyndall {

/// Time of the game: the wall clock, or fixed steps for reproducible runs. What a frame takes beyond `longest_step`
/// is lost, so that a pause does not jump; slower frames than that slow the game down.
class FrameClock {
  public:
    static constexpr double longest_step = 2;  ///< s
    static FrameClock wall() { return FrameClock(0); }
    static FrameClock fixed(double step_seconds) { return FrameClock(step_seconds); }
    /// Advances one frame and returns its step in seconds.
    double tick();
    [[nodiscard]] double time() const { return time_; }

  private:
    explicit FrameClock(double fixed) : fixed_(fixed) {}
    double fixed_;
    double time_ = 0;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace tyndall
