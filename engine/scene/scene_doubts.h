#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace tyndall {

/// What looks like a mistake of who made the scene, a line each: no light, no camera, lights in other units than cd
/// and lx, an exposure that suits no light, emission that is invisible beside lights, fog beyond the far end, and
/// the loader's own doubts. `far_end`, m: from there on fog is lit coarsely. The scene is as loaded, without what
/// add_missing_camera() and add_missing_sun() add.
[[nodiscard]] std::vector<std::string> likely_mistakes(const Scene& scene, const GltfNotes& notes, float far_end);

}  // namespace tyndall
