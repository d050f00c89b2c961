#include "engine/render/passes/gbuffer.h"

#include <algorithm>
#include <array>

#include "engine/gl/state.h"

namespace tyndall {
namespace {

const ProgramDesc program{
    "gbuffer",
    {{GL_VERTEX_SHADER, "shaders/engine/gbuffer.vert"}, {GL_FRAGMENT_SHADER, "shaders/engine/gbuffer.frag"}},
    {{"ALPHA_MASK", {0, 1}}},
    {}};
const ProgramRegistry::Registration registration(program);

/// An instance whose transform mirrors has its triangles wound the other way: its front faces would be culled.
bool any_mirrored(const FrameContext& frame) {
    return std::ranges::any_of(frame.gpu.instances(), [&](const Instance& instance) {
        const auto node = static_cast<std::size_t>(instance.node);
        return glm::determinant(glm::mat3(frame.scene.nodes[node].world)) < 0;
    });
}

void bind_material(const gl::Program& shader, const GpuScene::GpuMaterial& material) {
    const std::array<GLuint, 5> textures{material.base_color, material.metallic_roughness, material.normal,
                                         material.occlusion, material.emissive};
    glBindTextures(0, static_cast<GLsizei>(textures.size()), textures.data());
    shader.set("base_color_factor", material.base_color_factor);
    shader.set("emissive_alpha_cutoff", material.emissive_alpha_cutoff);
    shader.set("metallic_roughness_normal_occlusion", material.metallic_roughness_normal_occlusion);
    shader.set("dielectric_f0", material.dielectric_f0);
    shader.use();
}

}  // namespace

GBuffer GBufferPass::add(FrameContext& frame) {
    const auto target = [&](const char* name, GLenum format) {
        return frame.passes.create(name, {gl::TextureKind::d2, format, {frame.size, 1}, 1});
    };
    GBuffer g{target("albedo", GL_SRGB8_ALPHA8), target("normal", GL_RG16), target("material", GL_RGBA8),
              target("emissive", GL_RGBA16F), target("depth", GL_DEPTH_COMPONENT32F)};
    draws_.build(frame.gpu, Frustum::from(frame.view.view_projection), DrawList::Filter::all);
    frame.passes.add(
        "gbuffer",
        [&](PassBuilder& pass) {
            g.albedo = pass.attach_color(g.albedo);
            g.normal = pass.attach_color(g.normal);
            g.material = pass.attach_color(g.material);
            g.emissive = pass.attach_color(g.emissive);
            g.depth = pass.attach_depth(g.depth);
        },
        [this, &frame](const PassContext& pass) {
            pass.bind_framebuffer();
            draw(frame);
        });
    return g;
}

void GBufferPass::draw(const FrameContext& frame) const {
    const gl::Program* const programs[] = {&frame.shaders.get(program, {{"ALPHA_MASK", 0}}),
                                           &frame.shaders.get(program, {{"ALPHA_MASK", 1}})};
    const GLenum cull = any_mirrored(frame) ? GL_NONE : GL_BACK;
    const gl::DrawState one_sided{.depth_test = true, .depth_write = true, .cull = cull};
    const gl::DrawState two_sided{.depth_test = true, .depth_write = true};
    gl::apply(two_sided);
    constexpr float zero[4] = {0, 0, 0, 0};
    for (GLint target = 0; target < 4; ++target) glClearBufferfv(GL_COLOR, target, zero);
    glClearBufferfv(GL_DEPTH, 0, zero);

    glBindSamplers(0, 5, nullptr);  // the scene's textures carry their own sampling
    frame.gpu.bind();
    draws_.draw(frame.gpu, [&](int index) {
        const GpuScene::GpuMaterial& material = frame.gpu.material(index);
        gl::apply(material.double_sided ? two_sided : one_sided);
        glEnable(GL_FRAMEBUFFER_SRGB);  // the albedo target encodes; the next pass's state turns it off
        bind_material(*programs[material.alpha_mask ? 1 : 0], material);
    });
}

}  // namespace tyndall
