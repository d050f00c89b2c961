#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/image.h"

namespace tyndall::bench {

/// Pictures of a point, relative to the folder of the run: what was compared, and where it is wrong.
struct PictureNames {
    std::string light, error, truth;
};
/// Of keys (Point::key) and subjects (Point::subject); others each time.
[[nodiscard]] PictureNames picture_names(const std::string& key, const std::string& subject);

/// Writes all three as JPEG. The scattering layer exposed as the ground truth asks for and tonemapped; and its
/// difference from the truth as a mean over channels, white where it is half of the truth's mean, black where
/// `same` says that they see another surface.
void write_pictures(const std::filesystem::path& folder, const PictureNames& names, const Image& scattering,
                    const Image& truth, const std::vector<bool>& same);

}  // namespace tyndall::bench
