#pragma once

#include <string>
#include <vector>

#include "bench/suites.h"

namespace tyndall::bench {

enum class Marker { circle, square, triangle, diamond, cross, plus, star, triangle_down };

/// A row of the benchmark: a technique, the settings that are fixed, the one that buys accuracy with time, and its
/// look. A new technique joins every suite by one row in `families()`.
struct Family {
    std::string name, technique;
    std::vector<std::string> settings;
    std::string cost_key;  ///< empty: none
    std::vector<std::string> costs;
    std::string color;
    Marker marker = Marker::circle;
    int history_frames = 0;
    /// No competitor: its error is what the engine's shadow maps leave to any technique. Drawn as a level.
    bool limit = false;
};
[[nodiscard]] const std::vector<Family>& families();
[[nodiscard]] const Family& family(const std::string& name);  ///< a failed check when there is none

/// Frames after which a mean over frames has what it can have.
inline constexpr int settled_frames = 32;
/// Of one frame (history_frames 0) that knows no other, or of the technique as it comes.
[[nodiscard]] std::vector<std::string> base_settings(const std::string& technique, int history_frames);

/// The family at each of its costs, from the cheapest on; none where it is for other suites.
[[nodiscard]] std::vector<Configuration> expand(const Family& family);

}  // namespace tyndall::bench
