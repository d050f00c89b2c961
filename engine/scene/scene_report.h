#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace tyndall {

/// What is in a scene, as text for people: counts, bounds in m, cameras, lights in cd and lx, media in 1/m,
/// textures, animations, extensions, what is left out and why, and `doubts`. Some dozen lines and one for each
/// thing that has a name. The scene is as loaded, at time 0.
[[nodiscard]] std::string report(const Scene& scene, const GltfNotes& notes,
                                 const std::vector<std::string>& doubts);

}  // namespace tyndall
