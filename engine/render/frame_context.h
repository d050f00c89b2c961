#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/gl/buffer.h"
#include "engine/graph/pass_list.h"
#include "engine/render/frame_facts.h"
#include "engine/render/gpu_scene.h"
#include "engine/render/render_settings.h"
#include "engine/scene/view.h"
#include "engine/shader/shader_library.h"
#include "shaders/shared/frame.h"

namespace tyndall {

/// What every pass of the engine and every module gets while the frame's pass list is built.
struct FrameContext {
    const Scene& scene;
    GpuScene& gpu;
    const View& view;
    const FrameFacts& facts;
    const RenderSettings& settings;
    ShaderLibrary& shaders;
    PassList& passes;
    shared::FrameData& frame;  ///< passes fill their part while they are added; uploaded before execute
    glm::ivec2 size;
    double time = 0;
    std::uint32_t frame_index = 0;
    bool count_work = false;
    bool progressive = false;                  ///< what may be built over several frames is
    std::span<const std::string> layers = {};  ///< that will be read, see Renderer::layer_names
};

}  // namespace tyndall
