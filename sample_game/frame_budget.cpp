#include "sample_game/frame_budget.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

float FrameBudget::next(float scale, double ms) {
    constexpr std::size_t frames = 5;
    constexpr double idle = 0.8, full = 1.05, aim = 0.92;  // of the budget
    frames_.push_back(ms);
    if (frames_.size() < frames) return scale;
    std::ranges::nth_element(frames_, frames_.begin() + frames / 2);
    const double load = frames_[frames / 2] / budget_;
    frames_.clear();
    if (load >= idle && load <= full) return scale;
    // What a frame takes grows at most as its pixels do.
    const double pixels = std::clamp(aim / load, 0.6, aim / idle);
    return std::clamp(scale * static_cast<float>(std::sqrt(pixels)), least_, most_);
}

}  // namespace tyndall
