#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/gl/work_counters.h"

namespace tyndall::bench {

using PassTimes = std::vector<std::pair<std::string, double>>;  ///< ms, in the frame's order

/// Against the ground truth of the place. Without `display`, only `scattering` is known.
struct Errors {
    double scattering = 0;     ///< relative RMSE of the scattering layer, over pixels that see the same surface
    double flip = 0;           ///< mean HDR FLIP of the colour layer, 0..1
    double transmittance = 0;  ///< RMSE of the transmittance layer
    double dim = 0;            ///< as `scattering`, without the 2% of pixels that are brightest in the ground truth
    double masked = 0;         ///< share of pixels left out of these: another surface is seen there
    double invalid = 0;        ///< values that are not finite, negative, or a transmittance above 1
    double edge = 0;           ///< relative RMSE within two pixels of a depth edge (image_edges.h)
    double rest = 0;           ///< and of the other pixels
};

/// Of a static camera.
struct Motion {
    double flicker = 0;                ///< of the scattering layer, over 8 frames: image_metrics.h
    std::array<double, 3> residual{};  ///< of the light switched off, 1, 2 and 4 frames after: image_metrics.h
};

/// Of one frame of a sequence.
struct FrameErrors {
    double error = 0;     ///< relative RMSE of the scattering layer against the ground truth of the frame's pose
    double dim = 0;       ///< the same without the brightest 2%
    double to_limit = 0;  ///< at rest, against the mean of many frames with as many steps: what more frames could
                          ///< take away
};

/// All that was measured at one point, or of one sequence.
struct Measured {
    std::vector<PassTimes> times;  ///< one for each timed frame
    std::optional<Errors> errors;
    std::optional<Motion> motion;
    std::optional<gl::WorkCounts> work;  ///< sum of the passes volumetrics/*
    std::vector<FrameErrors> frames;     ///< of a sequence
};

/// Measurements of one folder: measurements.jsonl, to which each one is appended as it is made, so that an
/// interrupted run loses none; and bench.json, under which conditions they were made.
class Store {
  public:
    /// With `resume`, goes on from what the folder holds; throws UsageError naming what differs when it was
    /// measured under other `conditions` (a flat object). Without, begins anew. Throws Error when the folder cannot
    /// be written.
    Store(const std::filesystem::path& folder, const nlohmann::json& conditions, bool resume);

    [[nodiscard]] const Measured& at(const std::string& key) const;  ///< empty where nothing was measured
    void add_time(const std::string& key, const PassTimes& times);
    void add_errors(const std::string& key, const Errors& errors);
    void add_motion(const std::string& key, const Motion& motion);
    void add_work(const std::string& key, const gl::WorkCounts& work);
    void add_frames(const std::string& key, const std::vector<FrameErrors>& frames);  ///< in place of earlier ones

  private:
    void load(const std::filesystem::path& log);
    void append(const nlohmann::json& record);
    void apply(const nlohmann::json& record);

    std::map<std::string, Measured> measured_;
    std::ofstream log_;
    std::filesystem::path path_;
};

}  // namespace tyndall::bench
