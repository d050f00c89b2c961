#include "reconstruction/reconstruction.h"

namespace tyndall::volumetrics {
namespace {

/// In one pass; more than the six of a rest and two parts take another.
constexpr std::size_t most_textures = 6;

const ProgramDesc program{.name = "volumetrics/upsample",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/upsample.frag"}},
                          .axes = {{"TEXTURES", {1, 2, 3, 4, 5, 6}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

void add_upsample(Frame& frame, Textures textures) {
    if (textures.size() > most_textures) {
        add_upsample(frame, textures.first(most_textures));
        return add_upsample(frame, textures.subspan(most_textures));
    }
    std::vector<Pass::Source> sources{{frame.inputs.depth}, {frame.depth}};
    for (TextureRef* texture : textures) {
        sources.push_back({*texture});
        *texture = create_like(frame, "volumetrics/upsample", *texture, frame.inputs.size);
    }
    frame.add(
        {.name = "volumetrics/upsample",
         .program = frame.program(program, {{"TEXTURES", static_cast<int>(textures.size())}}),
         .sources = sources,
         .targets = {textures.begin(), textures.end()},
         .set = [factor = resolution_factor(frame.settings), mode = static_cast<int>(frame.settings.upsample),
                 falloff = frame.settings.filter_depth_falloff](const PassContext&, const gl::Program& shader) {
             shader.set("factor", factor);
             shader.set("mode", mode);
             shader.set("depth_falloff", falloff);
         }});
}

}  // namespace tyndall::volumetrics
