#include "engine/render/passes/lighting.h"

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "shaders/shared/lights.h"

namespace tyndall {
namespace {

const ProgramDesc program{
    "lighting",
    {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "shaders/engine/lighting.frag"}},
    {{"HAS_SUN", {0, 1}},
     {"HAS_LAMPS", {0, 1}},
     {"HAS_AMBIENT", {0, 1}},
     {"SKY_VISIBILITY", {0, 1}},
     {"SHADOWS", {0, 1}},
     {"MEDIUM_TRANSMITTANCE", {0, 1}},
     {"LIGHT_VOLUMES", {0, 1, 2}},
     {"GLASS", {0, GLASS_SUN, GLASS_LAMPS, GLASS_SUN | GLASS_LAMPS}},
     {"COUNT_WORK", {0, 1}}},
    [](const Permutation& p) {
        const bool lights = p.at("HAS_SUN") != 0 || p.at("HAS_LAMPS") != 0;
        if (p.at("LIGHT_VOLUMES") != 0 && p.at("MEDIUM_TRANSMITTANCE") == 0) return false;
        if (p.at("LIGHT_VOLUMES") == 2 && p.at("HAS_SUN") == 0) return false;
        if (p.at("SKY_VISIBILITY") > p.at("HAS_AMBIENT")) return false;
        if (p.at("GLASS") != 0 && p.at("SHADOWS") == 0) return false;
        if ((p.at("GLASS") & GLASS_SUN) != 0 && p.at("HAS_SUN") == 0) return false;
        if ((p.at("GLASS") & GLASS_LAMPS) != 0 && p.at("HAS_LAMPS") == 0) return false;
        return lights || (p.at("SHADOWS") == 0 && p.at("MEDIUM_TRANSMITTANCE") == 0);
    }};
const ProgramRegistry::Registration registration(program);

Permutation permutation(const FrameContext& frame, const LightSources& sources) {
    Permutation defines = sources.defines;
    const bool lamps = frame.facts.local_lights_in_view > 0, lights = frame.facts.has_sun || lamps;
    defines.merge(Permutation{{"HAS_SUN", frame.facts.has_sun},
                              {"HAS_LAMPS", lamps},
                              {"HAS_AMBIENT", frame.facts.has_ambient},
                              {"SKY_VISIBILITY", frame.facts.sky_visibility},
                              {"SHADOWS", frame.settings.shadows && lights},
                              {"MEDIUM_TRANSMITTANCE", 0},
                              {"LIGHT_VOLUMES", 0},
                              {"GLASS", frame.facts.glass()},
                              {"COUNT_WORK", frame.count_work}});
    return defines;
}

}  // namespace

TextureRef add_lighting(FrameContext& frame, const GBuffer& g, const LightSources& sources, TextureRef color) {
    const std::vector<TextureRef> inputs{g.albedo, g.normal, g.material, g.emissive, g.depth, sources.sky};
    frame.passes.add(
        "lighting",
        [&](PassBuilder& pass) {
            for (TextureRef input : inputs) pass.sample(input);
            for (TextureRef texture : sources.textures) pass.sample(texture);
            for (BufferRef buffer : sources.buffers) pass.read(buffer);
            color = pass.attach_color(color);
            pass.attach_depth_read_only(g.depth);
        },
        [&frame, &sources, inputs](const PassContext& pass) {
            pass.bind_framebuffer();
            // The triangle lies at depth 0: only pixels with a surface are shaded.
            gl::apply({.depth_test = true, .depth_func = GL_LESS});
            constexpr float black[4] = {0, 0, 0, 1};
            glClearBufferfv(GL_COLOR, 0, black);
            sources.bind();
            for (std::size_t unit = 0; unit < inputs.size(); ++unit)
                glBindTextureUnit(static_cast<GLuint>(unit), inputs[unit] ? pass.texture(inputs[unit]).id : 0);
            glBindSamplers(0, static_cast<GLsizei>(inputs.size()), nullptr);
            frame.shaders.get(program, permutation(frame, sources)).use();
            gl::draw_fullscreen();
        });
    return color;
}

}  // namespace tyndall
