#include <gmock/gmock.h>

#include <array>
#include <numeric>

#include "engine/core/error.h"
#include "engine/gl/buffer.h"
#include "engine/gl/framebuffer.h"
#include "engine/gl/readback.h"
#include "tests/gpu/support/gl_test.h"

namespace tyndall::gl {
namespace {

using GlTexture = GlTest;

std::vector<float> counting(int n) {
    std::vector<float> values(static_cast<std::size_t>(n));
    std::iota(values.begin(), values.end(), 0.0f);
    return values;
}

TEST_F(GlTexture, UploadComesBackWithTheTopRowFirst) {
    Texture texture({TextureKind::d2, GL_RG32F, {3, 5, 1}, 1}, "round trip");
    const std::vector<float> data = counting(3 * 5 * 2);
    texture.upload(0, GL_RG, GL_FLOAT, data.data());
    const Image image = read_texture(texture);
    ASSERT_EQ(image.size, glm::ivec2(3, 5));
    ASSERT_EQ(image.channels, 2);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 3; ++x)
            for (int c = 0; c < 2; ++c)
                EXPECT_EQ(image.at(x, y)[c], static_cast<float>(((4 - y) * 3 + x) * 2 + c)) << x << ' ' << y;
}

TEST_F(GlTexture, BytesOfAnOddWidthArePackedTightly) {
    Texture texture({TextureKind::d2, GL_R8, {3, 2, 1}, 1}, "odd");
    const std::array<GLubyte, 6> data{0, 51, 102, 153, 204, 255};
    texture.upload(0, GL_RED, GL_UNSIGNED_BYTE, data.data());
    const Image image = read_texture(texture);
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(image.at(i % 3, 1 - i / 3)[0], 0.2f * static_cast<float>(i), 1e-6f) << i;
}

TEST_F(GlTexture, EveryKindGivesItsLayers) {
    const TextureDesc descs[] = {{TextureKind::d3, GL_R32F, {4, 4, 6}, 1},
                                 {TextureKind::d2_array, GL_R32F, {4, 4, 6}, 1},
                                 {TextureKind::cube, GL_R32F, {4, 4, 1}, 1},
                                 {TextureKind::cube_array, GL_R32F, {4, 4, 2}, 1}};
    for (const TextureDesc& desc : descs) {
        const int layers = desc.kind == TextureKind::cube_array ? 12 : 6;
        Texture texture(desc, "layers");
        const std::vector<float> data = counting(16 * layers);
        texture.upload(0, GL_RED, GL_FLOAT, data.data());
        const std::vector<float> replaced(16, -1.0f);
        texture.upload_layer(0, 2, GL_RED, GL_FLOAT, replaced.data());
        for (int layer = 0; layer < layers; ++layer)
            EXPECT_EQ(read_texture(texture, layer).at(1, 3)[0],
                      layer == 2 ? -1.0f : static_cast<float>(layer * 16 + 1))
                << static_cast<int>(desc.kind) << ' ' << layer;
    }
}

TEST_F(GlTexture, DepthComesBackAsOneChannel) {
    Texture texture({TextureKind::d2, GL_DEPTH_COMPONENT32F, {4, 2, 1}, 1}, "depth");
    texture.clear_float(0.25f, 0, 0, 0);
    const Image image = read_texture(texture);
    EXPECT_EQ(image.channels, 1);
    EXPECT_THAT(image.pixels, testing::Each(0.25f));

    Texture shadow({TextureKind::d2_array, GL_DEPTH_COMPONENT32F, {4, 2, 3}, 1}, "depth array");
    shadow.clear_float(0, 0, 0, 0);
    const std::vector<float> half(8, 0.5f);
    shadow.upload_layer(0, 1, GL_DEPTH_COMPONENT, GL_FLOAT, half.data());
    EXPECT_THAT(read_texture(shadow, 0).pixels, testing::Each(0.0f));
    EXPECT_THAT(read_texture(shadow, 1).pixels, testing::Each(0.5f));
}

TEST_F(GlTexture, IntegersComeBackAsNumbers) {
    Texture texture({TextureKind::d2, GL_R32UI, {2, 1, 1}, 1}, "integers");
    const std::array<GLuint, 2> data{7, 65536};
    texture.upload(0, GL_RED_INTEGER, GL_UNSIGNED_INT, data.data());
    EXPECT_THAT(read_texture(texture).pixels, testing::ElementsAre(7.0f, 65536.0f));
}

TEST_F(GlTexture, ClearAndMipmapsFillAllLevels) {
    Texture texture({TextureKind::d2, GL_RGBA16F, {8, 4, 1}, 0}, "mips");
    EXPECT_EQ(texture.desc().levels, 4);
    texture.clear_float(1, 2, 3, 4);
    std::array<float, 4> last{};
    glGetTextureImage(texture.id(), 3, GL_RGBA, GL_FLOAT, sizeof last, last.data());
    EXPECT_THAT(last, testing::ElementsAre(1, 2, 3, 4));

    std::vector<float> data(8 * 4 * 4, 0.0f);
    for (std::size_t i = 0; i < data.size() / 2; ++i) data[i] = 1;  // lower half
    texture.upload(0, GL_RGBA, GL_FLOAT, data.data());
    texture.generate_mipmaps();
    glGetTextureImage(texture.id(), 3, GL_RGBA, GL_FLOAT, sizeof last, last.data());
    EXPECT_THAT(last, testing::Each(testing::FloatNear(0.5f, 1e-3f)));
}

TEST_F(GlTexture, TooLargeIsAnErrorThatSaysTheLimit) {
    const auto make = [] { Texture({TextureKind::d2, GL_RGBA8, {1 << 20, 8, 1}, 1}, "huge"); };
    EXPECT_THAT(make, testing::ThrowsMessage<Error>(
                          testing::AllOf(testing::HasSubstr("'huge'"), testing::HasSubstr("1048576x8"))));
    EXPECT_THROW(Texture({TextureKind::d2, GL_RGBA8, {0, 8, 1}, 1}, "empty"), Error);
    EXPECT_THROW(Texture({TextureKind::d3, GL_RGBA8, {8, 8, 1 << 16}, 1}, "deep"), Error);
}

TEST_F(GlTexture, ByteSizeCountsLevelsAndLayers) {
    EXPECT_EQ(byte_size({TextureKind::d2, GL_RGBA16F, {16, 8, 1}, 0}), (128U + 32 + 8 + 2 + 1) * 8);
    EXPECT_EQ(byte_size({TextureKind::d3, GL_R8, {4, 4, 4}, 0}), 64U + 8 + 1);
    EXPECT_EQ(byte_size({TextureKind::d2_array, GL_R8, {4, 4, 4}, 0}), (16U + 4 + 1) * 4);
    EXPECT_EQ(byte_size({TextureKind::cube_array, GL_R32F, {2, 2, 3}, 1}), 4U * 4 * 18);
}

TEST_F(GlTexture, FramebufferHasTheSizeOfItsLevel) {
    const Texture texture({TextureKind::d2_array, GL_RGBA8, {20, 9, 2}, 0}, "target");
    const Attachment attachment{texture, 1, 1};
    const Framebuffer framebuffer({&attachment, 1}, nullptr, "level 1");
    EXPECT_EQ(framebuffer.size(), glm::ivec2(10, 4));
    framebuffer.bind();
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    EXPECT_THAT(viewport, testing::ElementsAre(0, 0, 10, 4));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
}

TEST_F(GlTexture, IncompleteFramebufferIsAnErrorThatNamesIt) {
    const Texture texture({TextureKind::d2, GL_RGB9_E5, {4, 4, 1}, 1}, "not renderable");
    const auto make = [&] {
        const Attachment attachment{texture};
        const Framebuffer framebuffer({&attachment, 1}, nullptr, "broken");
    };
    EXPECT_THAT(make, testing::ThrowsMessage<Error>(testing::HasSubstr("framebuffer 'broken'")));
    reset_debug_messages();  // the driver reports it, too
}

TEST_F(GlTexture, BufferGrowsAndKeepsWhatFits) {
    Buffer buffer;
    const std::array<int, 3> first{1, 2, 3};
    buffer.assign(std::span<const int>(first), "list");
    const GLuint id = buffer.id();
    const std::array<int, 2> shorter{8, 9};
    buffer.assign(std::span<const int>(shorter), "list");
    EXPECT_EQ(buffer.id(), id);
    std::array<int, 3> read{};
    buffer.read(0, sizeof read, read.data());
    EXPECT_THAT(read, testing::ElementsAre(8, 9, 3));

    std::vector<int> longer(100, 5);
    buffer.assign(std::span<const int>(longer), "list");
    EXPECT_GE(buffer.size(), 400U);
    std::vector<int> back(100);
    buffer.read(0, 400, back.data());
    EXPECT_EQ(back, longer);
    buffer.clear_uint(6);
    buffer.read(0, sizeof read, read.data());
    EXPECT_THAT(read, testing::Each(6));
}

TEST_F(GlTexture, AnEmptyListStillHasABuffer) {
    Buffer buffer;
    buffer.assign(std::span<const int>(), "empty list");
    EXPECT_TRUE(buffer);
    buffer.bind(GL_SHADER_STORAGE_BUFFER, 0);
}

}  // namespace
}  // namespace tyndall::gl
