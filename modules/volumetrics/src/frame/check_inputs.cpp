#include "frame/check_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "engine/core/error.h"

namespace tyndall::volumetrics {
namespace {

template <class... Arguments>
void require(bool ok, fmt::format_string<const Arguments&...> text, const Arguments&... arguments) {
    if (!ok) throw Error("volumetrics: " + fmt::format(text, arguments...));
}

template <int columns, int rows>
bool is_finite(const glm::mat<columns, rows, float>& m) {
    for (int c = 0; c < columns; ++c)
        for (int r = 0; r < rows; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}
bool is_finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_texture(const PassList& passes, const char* name, TextureRef ref, glm::ivec2 size,
                   std::initializer_list<GLenum> formats, const char* expected) {
    require(passes.holds(ref),
            "{} is no texture of this pass list in its newest version: pass on what passes return", name);
    const gl::TextureDesc& desc = passes.desc(ref);
    require(desc.size == glm::ivec3(size, 1), "{} is {} x {} x {}, of Inputs::size {} x {} expected", name,
            desc.size.x, desc.size.y, desc.size.z, size.x, size.y);
    require(std::ranges::count(formats, desc.format) > 0, "{} has the format 0x{:x}, {} expected", name,
            desc.format, expected);
}

}  // namespace

void check_inputs(const Inputs& inputs) {
    require(static_cast<bool>(inputs.depth), "Inputs::depth is empty, the host's depth buffer expected");
    require(inputs.size.x > 0 && inputs.size.y > 0, "Inputs::size is {} x {}, at least 1 x 1 expected",
            inputs.size.x, inputs.size.y);
    require(is_finite(inputs.eye), "Inputs::eye is ({}, {}, {}), finite numbers expected", inputs.eye.x,
            inputs.eye.y, inputs.eye.z);
    require(is_finite(inputs.view),
            "Inputs::view has a number that is not finite, a matrix from world to view expected");
    require(is_finite(inputs.projection),
            "Inputs::projection has a number that is not finite, a reversed projection expected");
    require(std::isfinite(inputs.znear) && inputs.znear > 0, "Inputs::znear is {}, a positive distance expected",
            inputs.znear);
    require(inputs.has_lamps || inputs.lamps.empty(),
            "Inputs::lamps has {} lamps and has_lamps is false, none expected", inputs.lamps.size());
    const glm::vec3 sun = inputs.sun_direction;
    require(!inputs.has_sun || std::abs(glm::length(sun) - 1) < 0.01F,
            "Inputs::sun_direction is ({}, {}, {}), a unit vector expected", sun.x, sun.y, sun.z);
}

void check_textures(const PassList& passes, const Inputs& inputs) {
    check_texture(passes, "Inputs::depth", inputs.depth, inputs.size, {GL_DEPTH_COMPONENT32F, GL_DEPTH32F_STENCIL8},
                  "D32F or D32F_S8");
    if (inputs.motion) check_texture(passes, "Inputs::motion", inputs.motion, inputs.size, {GL_RG16F}, "RG16F");
    for (const TextureRef texture : inputs.light_textures)
        require(!texture || passes.holds(texture),
                "one of Inputs::light_textures is no texture of this pass list in its newest version");
}

void check_color(const PassList& passes, TextureRef color, glm::ivec2 size) {
    check_texture(passes, "the color of composite()", color, size, {GL_RGBA16F, GL_RGBA32F}, "RGBA16F or RGBA32F");
}

}  // namespace tyndall::volumetrics
