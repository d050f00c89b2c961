#pragma once

#include "bench/suites.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"

namespace tyndall::bench {

/// The parts of a scene that edits change, to be put back.
class SceneEditor {
  public:
    explicit SceneEditor(const Scene& scene) : lights_(scene.lights), media_(scene.media) {}
    /// Puts the scene back and applies `edit`. Spheres of 0.5 m fill the view from 3 to 30 m evenly (in the image
    /// and in ln depth, by the sequence of Roberts' generalised golden ratio), so that more of them is more of the
    /// same.
    void apply(Scene& scene, const View& view, const SceneEdit& edit) const;

  private:
    std::vector<Light> lights_;
    std::vector<Medium> media_;
};

}  // namespace tyndall::bench
