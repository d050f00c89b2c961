#pragma once

#include <string>
#include <vector>

#include "bench/suites.h"

namespace tyndall::bench {

enum class Marker { circle, square, triangle, diamond, cross, plus, star, triangle_down };

/// The values a setting takes in a suite. `lamps_only`: left out where no lamp is in view.
struct Axis {
    std::string key;
    std::vector<std::string> values;
    bool lamps_only = false;
};

/// A row of the benchmark: a technique, the settings that are fixed, those that vary, and its look. A new technique
/// joins every suite by one row in `families()`.
struct Family {
    std::string name, technique;
    std::vector<std::string> settings;
    std::vector<Axis> axes;  ///< all combinations; `cost_key` names the one that buys accuracy with time
    std::string cost_key;    ///< empty: none
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

/// All combinations of a family's axes. The first value of each axis but the cost's is the one drawn filled.
[[nodiscard]] std::vector<Configuration> expand(const Family& family, const PlaceFacts& facts);

}  // namespace tyndall::bench
