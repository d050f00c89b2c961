#include "engine/render/passes/depth_pyramid.h"

namespace tyndall {
namespace {

const ProgramDesc program{"depth_pyramid", {{GL_COMPUTE_SHADER, "shaders/engine/depth_pyramid.comp"}}, {}, {}};
const ProgramRegistry::Registration registration(program);

void reduce(const gl::Program& shader, const gl::TextureView& depth, const gl::TextureView& pyramid) {
    shader.use();
    for (int level = 0; level < pyramid.desc.levels; ++level) {
        if (level > 0) glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
        glBindTextureUnit(0, level == 0 ? depth.id : pyramid.id);
        glBindImageTexture(0, pyramid.id, level, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
        shader.set("source_level", level == 0 ? 0 : level - 1);
        const glm::ivec2 size = glm::max(glm::ivec2(pyramid.desc.size) >> level, glm::ivec2(1));
        const glm::uvec2 groups((size + 7) / 8);
        glDispatchCompute(groups.x, groups.y, 1);
    }
}

}  // namespace

TextureRef add_depth_pyramid(FrameContext& frame, TextureRef depth) {
    const glm::ivec2 size = glm::max(frame.size / 2, glm::ivec2(1));
    TextureRef pyramid = frame.passes.create("depth pyramid", {gl::TextureKind::d2, GL_R32F, {size, 1}, 0});
    frame.passes.add(
        "depth_pyramid",
        [&](PassBuilder& pass) {
            pass.sample(depth);
            pyramid = pass.storage_write(pyramid);
        },
        [&shaders = frame.shaders, depth, pyramid](const PassContext& pass) {
            reduce(shaders.get(program), pass.texture(depth), pass.texture(pyramid));
        });
    return pyramid;
}

}  // namespace tyndall
