#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/core/image.h"
#include "engine/graph/pass_list.h"
#include "engine/render/passes/gbuffer.h"

namespace tyndall {

/// `convert` of every pixel, into an image of `channels`.
[[nodiscard]] Image convert_pixels(const Image& from, int channels,
                                   const std::function<void(const float* in, float* out)>& convert);

/// A picture of a frame that can be asked for by its name.
struct Layer {
    /// From all that the texture holds, and the frame's size, to what Renderer::read_layer gives.
    using Decode = std::function<Image(const Image& texture, glm::ivec2 size)>;
    [[nodiscard]] static Image rgb(const Image& texture, glm::ivec2 size);    ///< the first three channels
    [[nodiscard]] static Image alpha(const Image& texture, glm::ivec2 size);  ///< the fourth, three times

    std::string name;
    TextureRef texture;  ///< empty: the frame has none, and all of the layer is `absent`
    Decode decode = rgb;
    float absent = 0;
    bool is_light = false;  ///< the texture is in units of Scene::light_unit(); what is read is in cd/m²
};

/// Those of the G-buffer.
[[nodiscard]] std::vector<Layer> surface_layers(const GBuffer& gbuffer, float znear);

}  // namespace tyndall
