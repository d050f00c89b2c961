#pragma once

#include "engine/gl/program.h"
#include "engine/render/gpu_scene.h"

namespace tyndall {

/// Uses the program with the textures (units 0 to 4) and uniforms of shaders/engine/material.glsl and gbuffer.vert.
/// What shines is in units of `light_unit`, see Scene. The caller has no samplers on these units: the scene's
/// textures carry their own sampling.
void bind_material(const gl::Program& shader, const GpuScene::GpuMaterial& material, bool mirrored,
                   float light_unit);

}  // namespace tyndall
