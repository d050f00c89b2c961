#include "engine/render/passes/gbuffer.h"

#include <algorithm>

#include "engine/gl/state.h"
#include "engine/render/passes/material_binding.h"

namespace tyndall {
namespace {

const ProgramDesc program{
    "gbuffer",
    {{GL_VERTEX_SHADER, "shaders/engine/gbuffer.vert"}, {GL_FRAGMENT_SHADER, "shaders/engine/gbuffer.frag"}},
    {{"ALPHA_MASK", {0, 1}}, {"MOTION", {0, 1}}},
    {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

GBuffer GBufferPass::add(FrameContext& frame, const std::optional<glm::mat4>& previous_view_projection) {
    const auto target = [&](const char* name, GLenum format) {
        return frame.passes.create(name, {gl::TextureKind::d2, format, {frame.size, 1}, 1});
    };
    GBuffer g{target("albedo", GL_SRGB8_ALPHA8),      target("normal", GL_RG16),
              target("material", GL_RGBA8),           target("emissive", GL_RGBA16F),
              target("depth", GL_DEPTH_COMPONENT32F), {}};
    const Frustum frustum = Frustum::from(frame.view.view_projection);
    draws_.build(frame.gpu, frustum, DrawList::Filter::all);
    const bool motion = previous_view_projection && frame.gpu.has_moved(frustum);
    if (motion) g.motion = target("motion", GL_RG16F);
    frame.passes.add(
        "gbuffer",
        [&](PassBuilder& pass) {
            g.albedo = pass.attach_color(g.albedo);
            g.normal = pass.attach_color(g.normal);
            g.material = pass.attach_color(g.material);
            g.emissive = pass.attach_color(g.emissive);
            if (motion) g.motion = pass.attach_color(g.motion);
            g.depth = pass.attach_depth(g.depth);
        },
        [this, &frame, previous = motion ? previous_view_projection : std::nullopt](const PassContext& pass) {
            pass.bind_framebuffer();
            draw(frame, previous ? &*previous : nullptr);
        });
    return g;
}

void GBufferPass::draw(const FrameContext& frame, const glm::mat4* previous_view_projection) const {
    const int motion = previous_view_projection != nullptr ? 1 : 0;
    const gl::Program* const programs[] = {&frame.shaders.get(program, {{"ALPHA_MASK", 0}, {"MOTION", motion}}),
                                           &frame.shaders.get(program, {{"ALPHA_MASK", 1}, {"MOTION", motion}})};
    gl::apply({.depth_test = true, .depth_write = true});
    constexpr float zero[4] = {0, 0, 0, 0};
    for (GLint target = 0; target < 4 + motion; ++target) glClearBufferfv(GL_COLOR, target, zero);
    glClearBufferfv(GL_DEPTH, 0, zero);

    glBindSamplers(0, 5, nullptr);  // the scene's textures carry their own sampling
    if (motion != 0) {
        frame.gpu.bind_previous();
        for (const gl::Program* p : programs) p->set("u_previous_view_projection", *previous_view_projection);
    }
    draws_.draw(frame.gpu, [&](DrawList::Surfaces surfaces) {
        const GpuScene::GpuMaterial& material = frame.gpu.material(surfaces.material);
        gl::apply({.depth_test = true,
                   .depth_write = true,
                   .cull = static_cast<GLenum>(material.double_sided ? GL_NONE : GL_BACK),
                   .clockwise = surfaces.mirrored});
        glEnable(GL_FRAMEBUFFER_SRGB);  // the albedo target encodes; the next pass's state turns it off
        bind_material(*programs[material.alpha_mask ? 1 : 0], material, surfaces.mirrored,
                      frame.scene.light_unit());
        return true;
    });
}

}  // namespace tyndall
