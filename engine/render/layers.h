#pragma once

#include <string>

#include "engine/core/image.h"
#include "engine/gl/texture.h"

namespace tyndall {

struct LayerSource {
    glm::ivec2 size{0};
    float znear = 0;        ///< m
    bool in_alpha = false;  ///< all channels are the texture's alpha
};

/// Reads a layer of a frame (Renderer::layer_names) into the form that Renderer::read_layer promises. `texture` is
/// empty where the frame had no medium: then scattering is 0 and transmittance 1; acceptance without one is 0.
[[nodiscard]] Image decode_layer(const std::string& layer, const gl::TextureView& texture,
                                 const LayerSource& source);

}  // namespace tyndall
