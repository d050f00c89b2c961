#pragma once

#include <string>
#include <vector>

#include "bench/places.h"
#include "bench/store.h"
#include "bench/suites.h"
#include "engine/scene/view.h"

namespace tyndall::bench {

/// Frames drawn one after the other from no history, each compared with the ground truth of its pose.
struct Sequence {
    const Place* place = nullptr;
    glm::ivec2 size{0};
    std::string group;                  ///< a panel of a plot, a column of a table
    std::string name;                   ///< a curve, a row
    std::vector<std::string> settings;  ///< key=value
    std::vector<Pose> poses;            ///< one for each frame
    [[nodiscard]] std::string key() const;
};

struct SequenceSuite {
    std::string name, title;
    std::string what;                                    ///< for the report: what all sequences share
    std::vector<Sequence> sequences;                     ///< those of one place are neighbours
    double FrameErrors::*measure = &FrameErrors::error;  ///< in tables and plots
    std::vector<std::string> limit;                      ///< settings whose mean over many frames is compared too
};
/// noise, filters, temporal, walk, sequences (small, for the tests).
[[nodiscard]] const std::vector<std::string>& sequence_suite_names();
/// Throws UsageError (unknown place). The name is one of sequence_suite_names().
[[nodiscard]] SequenceSuite make_sequence_suite(const SuiteRequest& request);

/// Poses lights and camera of a scene that was animated to the place's time. A frame of motion: the camera goes
/// 0.05 m to its right and turns by 0.5 degrees; each light goes 0.05 m the same way and turns by 0.5 degrees round
/// the vertical through it.
[[nodiscard]] View pose(Scene& scene, const Place& place, glm::ivec2 size, const Pose& pose);

}  // namespace tyndall::bench
