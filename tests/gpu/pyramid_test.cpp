#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/core/files.h"
#include "engine/gl/readback.h"
#include "engine/render/passes/depth_pyramid.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

class DepthPyramid : public GlTest {
  protected:
    /// Levels of the pyramid over `depth` (rows from the bottom).
    std::vector<std::vector<float>> build(glm::ivec2 size, const std::vector<float>& depth) {
        gl::Texture source({gl::TextureKind::d2, GL_DEPTH_COMPONENT32F, {size, 1}, 1}, "test depth");
        source.upload(0, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
        test::SceneBuilder builder;
        builder.ground({0, 0, 0}, 1);
        GpuScene gpu(builder.finish());
        const View view;
        const FrameFacts facts;
        const RenderSettings settings;
        PassList passes;
        shared::FrameData data{};
        FrameContext frame{builder.scene, gpu, view, facts, settings, shaders_, passes, data, size};
        const TextureRef pyramid = add_depth_pyramid(frame, passes.import("depth", source));
        std::vector<std::vector<float>> levels;
        passes.add(
            "read",
            [&](PassBuilder& pass) {
                pass.sample(pyramid);
                pass.keep();
            },
            [&](const PassContext& pass) {
                const gl::TextureView view_of = pass.texture(pyramid);
                glMemoryBarrier(GL_ALL_BARRIER_BITS);
                for (int level = 0; level < view_of.desc.levels; ++level) {
                    const glm::ivec2 extent = glm::max(glm::ivec2(view_of.desc.size) >> level, glm::ivec2(1));
                    auto& texels = levels.emplace_back(static_cast<std::size_t>(extent.x * extent.y));
                    glGetTextureImage(view_of.id, level, GL_RED, GL_FLOAT,
                                      static_cast<GLsizei>(texels.size() * sizeof(float)), texels.data());
                }
            });
        passes.compile();
        TransientPool pool;
        passes.execute(pool);
        return levels;
    }
    ShaderLibrary& shaders_ = shared_shaders();
};

TEST_F(DepthPyramid, EachTexelIsTheFarthestOfExactlyThePixelsThatMapToIt) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const glm::ivec2 size : {glm::ivec2(64, 32), {37, 23}, {5, 1}, {1, 1}, {129, 3}}) {
        std::vector<float> depth(static_cast<std::size_t>(size.x * size.y));
        std::ranges::generate(depth, [&] { return unit(random); });
        const auto levels = build(size, depth);
        glm::ivec2 extent = size;
        for (std::size_t level = 0; level < levels.size(); ++level) {
            extent = glm::max(extent / 2, glm::ivec2(1));
            std::vector<float> expected(static_cast<std::size_t>(extent.x * extent.y), 1.0f);
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const glm::ivec2 texel =
                        glm::min(glm::ivec2(x, y) >> (static_cast<int>(level) + 1), extent - 1);
                    float& farthest = expected[static_cast<std::size_t>(texel.y * extent.x + texel.x)];
                    farthest = std::min(farthest, depth[static_cast<std::size_t>(y * size.x + x)]);
                }
            EXPECT_EQ(levels[level], expected) << size.x << "x" << size.y << " level " << level;
        }
        EXPECT_EQ(extent, glm::ivec2(1)) << "the chain ends at one texel";
    }
}

}  // namespace
}  // namespace tyndall
