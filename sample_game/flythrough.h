#pragma once

#include <filesystem>

#include "session/session.h"

namespace tyndall {

struct FlythroughOptions {
    std::filesystem::path out;
    double frames_per_second = 4;  ///< fixed time steps, as the paper throttles: every run draws the same frames
    double duration = 0;           ///< s; 0: the whole path
    bool lines = false;            ///< progress on stderr also where it is not a terminal
};

/// Draws the level's "flythrough" animation in fixed steps and writes into `out`: a still PLACE.png of the first
/// place at once and of each other as it is passed (all of them, however short `duration`), frames.csv
/// (milliseconds per frame and pass), summary.csv and summary.md (the frame breakdown of the ray-marching thesis,
/// table 4.3, with what it leaves out: the parts of the volumetrics sum to them, and with the other parts of the
/// frame to the whole; mean, standard deviation, variance). Throws Error when the scene has no such animation.
void fly_through(Session& session, const FlythroughOptions& options);

}  // namespace tyndall
