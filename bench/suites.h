#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "bench/places.h"

namespace tyndall::bench {

/// A technique with settings. `family` names a row of the tables in techniques.h, which gives it its look on plots.
struct Configuration {
    std::string family;
    std::vector<std::string> settings;  ///< key=value, beyond the defaults; `technique` first
    std::string label;                  ///< short, at a point of a plot
    std::string curve;                  ///< points of one family that a line joins: what all but the steps are
    int history_frames = 0;             ///< frames until what it accumulates has settled
    double weight = 1;                  ///< of a frame's cost against others of the place, for the time left only
    [[nodiscard]] std::string name() const;  ///< family and settings, unique within a place
};

/// Changes to a scene that count something.
struct SceneEdit {
    int lamps = -1;    ///< keep the first so many; -1: all
    int spheres = -1;  ///< replace the media by so many small spheres in view; -1: keep them
};

/// How far camera and lights are along their paths, in frames of motion (sequences.h).
struct Pose {
    int camera = 0, light = 0;
    bool operator==(const Pose&) const = default;
    [[nodiscard]] std::string name() const;  ///< part of a file's name; empty at rest
};

/// One thing to be measured.
struct Point {
    const Place* place = nullptr;
    glm::ivec2 size{0};
    SceneEdit edit;
    Pose pose;                        ///< of the ground truth of a sequence's frame
    bool light_transmittance = true;  ///< of the ground truth and the technique alike
    std::string variable;             ///< what `value` counts: steps, pixels, lamps …
    double value = 0;
    Configuration configuration;
    [[nodiscard]] std::string subject() const;  ///< place, size and edit: what shares one ground truth
    [[nodiscard]] std::string key() const;      ///< unique within a suite
};

/// Points of one scene file, measured in turns.
struct Group {
    std::string name;
    std::vector<Point> points;
    PlaceFacts facts;
    /// The first point's error is the aim: points behind the first with less error are left out.
    bool stop_below_first = false;
};

struct Suite {
    std::string name, title;
    std::vector<Group> groups;
    bool times = true;    ///< and work counters
    bool errors = true;   ///< of scattering
    bool display = true;  ///< and of transmittance and colour, flicker and lag
};

struct SuiteRequest {
    std::string name;
    glm::ivec2 size{0};
    std::vector<std::string> places;  ///< only these; empty: all of the suite
    bool against_gpu = false;         ///< the technique `reference` is the ground truth, and no competitor
};
/// Of make_suite(), and of sequences.h.
[[nodiscard]] const std::vector<std::string>& suite_names();
/// The suite's places that are wanted (all, if none is named), in the suite's order. Throws UsageError.
[[nodiscard]] std::vector<std::string> chosen_places(const std::string& suite, std::vector<std::string> places,
                                                     const std::vector<std::string>& wanted);
/// The ground truth that suits a suite: cpu, gpu or march.
[[nodiscard]] std::string default_reference(const std::string& suite);
/// Loads the scenes' facts. Throws UsageError (unknown suite or place) or Error (a scene that does not load).
[[nodiscard]] Suite make_suite(const SuiteRequest& request);

}  // namespace tyndall::bench
