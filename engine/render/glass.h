#pragma once

#include "engine/render/frame_facts.h"
#include "engine/render/gpu_scene.h"
#include "engine/scene/view.h"

namespace tyndall {

/// Whether light of that direction (in which it travels) may reach the view after it has met the box.
[[nodiscard]] bool shades(const Aabb& box, glm::vec3 direction, const Frustum& view);

/// Finds what glass may colour of what is in view: facts.sun_through_glass, and Lamp::through_glass of the lamps in
/// view. Glass is whatever is transparent and casts shadows. To be called after GpuScene::update.
void find_glass(const Scene& scene, const GpuScene& gpu, const View& view, FrameFacts& facts);

}  // namespace tyndall
