#pragma once

#include <string>
#include <vector>

namespace tyndall::bench {

/// A camera of a scene at an instant: what a picture is taken of.
struct Place {
    std::string name;   ///< unique over all places
    std::string scene;  ///< path in the data folder
    std::string camera = "view";
    double time = 0;  ///< s, of the scene's animations
};

[[nodiscard]] const std::vector<Place>& level_places();     ///< the six of the ray-marching thesis
[[nodiscard]] const std::vector<Place>& scene_places();     ///< the benchmark's own scenes
[[nodiscard]] const std::vector<Place>& torture_places();   ///< built to break numerics
[[nodiscard]] const Place& place(const std::string& name);  ///< a failed check when there is none

/// What of a place decides which settings matter there.
struct PlaceFacts {
    int lamps = 0;          ///< of the scene, that shine
    int lamps_in_view = 0;  ///< whose sphere of influence meets the view
    bool has_sun = false;
};
/// Loads the scene and its camera. Throws Error or UsageError.
[[nodiscard]] PlaceFacts place_facts(const Place& place, float aspect);

}  // namespace tyndall::bench
