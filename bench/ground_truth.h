#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/suites.h"
#include "engine/core/image.h"
#include "session/session.h"

namespace tyndall::bench {

/// `tyndall reference`; the technique `reference`; or what ray_march tends to with more samples, which leaves
/// errors of sampling only.
enum class TruthKind { cpu, gpu, march };
/// The froxels of suites that have this last truth, which is drawn with them: fewer, as pictures are small and all
/// techniques and settings share them.
[[nodiscard]] const std::vector<std::string>& few_froxels();
[[nodiscard]] TruthKind truth_kind(const std::string& name);  ///< cpu, gpu or march: a failed check otherwise

struct GroundTruth {
    Image color, scattering, transmittance;  ///< linear, 3 channels
    Image depth;                             ///< view depth, m, 0 on the sky; 3 equal channels
};

/// Ground truths as .exr files in a folder, made once. A file's name tells the scene's content, place, size and
/// kind, and for the GPU's the driver and its shaders, so that what has changed is made again.
class GroundTruths {
  public:
    GroundTruths(std::filesystem::path folder, TruthKind kind) : folder_(std::move(folder)), kind_(kind) {}
    /// `session` holds the point's scene as posed. Throws Error.
    [[nodiscard]] GroundTruth get(Session& session, const View& view, const Point& point) const;

  private:
    [[nodiscard]] std::string stem(Session& session, const Point& point) const;
    std::filesystem::path folder_;
    TruthKind kind_;
};

/// Means of the layers over `frames` frames, drawn with the settings that the session has.
[[nodiscard]] std::vector<Image> mean_of_frames(Session& session, const View& view, double time,
                                                const std::vector<std::string>& layers, int frames);

/// Layers of one frame, in the order of `layers`.
[[nodiscard]] std::vector<Image> draw_layers(Session& session, const View& view, double time,
                                             const std::vector<std::string>& layers);

}  // namespace tyndall::bench
