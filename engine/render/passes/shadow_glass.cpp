#include "engine/render/passes/shadow_glass.h"

#include "engine/gl/state.h"

namespace tyndall {
namespace {

const ProgramDesc program{"shadow_glass",
                          {{GL_VERTEX_SHADER, "shaders/engine/shadow_glass.vert"},
                           {GL_FRAGMENT_SHADER, "shaders/engine/shadow_glass.frag"}},
                          {{"LAYERS", {0, 1}}},
                          {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

gl::TextureDesc ShadowGlass::desc(int size, int layers) {
    return {.kind = gl::TextureKind::d2_array, .format = GL_RGBA16, .size = {size, size, layers}};
}

void ShadowGlass::clear() {
    constexpr float none[4] = {1, 1, 1, 0};
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearBufferfv(GL_COLOR, 0, none);
}

void ShadowGlass::draw(const GpuScene& gpu, const DrawList& list, int view, const Map& map) const {
    const bool layers = map.shadows.desc.kind == gl::TextureKind::d2_array;
    const gl::Program& shader = shaders_.get(program, {{"LAYERS", layers}});
    shader.set("world_to_clip", map.world_to_clip);
    shader.set("nearness", map.nearness);
    shader.set("scale", static_cast<float>(map.shadows.desc.size.x) / static_cast<float>(map.size));
    if (layers) shader.set("layer", map.layer);
    gl::apply({.blend = gl::Blend::filter, .depth_clamp = map.depth_clamp});
    glBindSamplers(0, 2, nullptr);  // the scene's textures carry their own sampling
    glBindTextureUnit(1, map.shadows.id);
    list.draw(
        gpu,
        [&](DrawList::Surfaces surfaces) {
            const GpuScene::GpuMaterial& material = gpu.material(surfaces.material);
            glBindTextureUnit(0, material.base_color);
            shader.set("base_color_factor", material.base_color_factor);
            shader.set("transmission", material.transmission);
            shader.use();
            return true;
        },
        view);
}

glm::vec4 tile_nearness(const shared::ShadowTile& tile, bool is_sun) {
    const glm::mat4 rows = glm::transpose(tile.world_to_clip);
    // A sun's w is the same everywhere, rows[3].w.
    return is_sun ? rows[2] / rows[3].w : glm::vec4(0, 0, 0, 1) - rows[3] / tile.depth.y;
}

}  // namespace tyndall
