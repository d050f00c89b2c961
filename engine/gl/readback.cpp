#include "engine/gl/readback.h"

#include <algorithm>

#include "engine/core/check.h"

namespace tyndall::gl {
namespace {

GLint level_parameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

struct Transfer {
    int channels;
    GLenum format, type;
};

Transfer transfer_of(GLuint texture) {
    if (level_parameter(texture, GL_TEXTURE_DEPTH_SIZE) > 0) return {1, GL_DEPTH_COMPONENT, GL_FLOAT};
    int channels = 0;
    for (GLenum size : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE})
        channels += level_parameter(texture, size) > 0 ? 1 : 0;
    TYNDALL_CHECK_LT(0, channels);
    const auto type = static_cast<GLenum>(level_parameter(texture, GL_TEXTURE_RED_TYPE));
    constexpr GLenum real[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    constexpr GLenum integer[] = {GL_RED_INTEGER, GL_RG_INTEGER, GL_RGB_INTEGER, GL_RGBA_INTEGER};
    const bool is_integer = type == GL_INT || type == GL_UNSIGNED_INT;
    return {channels, (is_integer ? integer : real)[channels - 1], is_integer ? type : GL_FLOAT};
}

void reset_pack_state() {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    for (GLenum name :
         {GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_IMAGES})
        glPixelStorei(name, 0);
}

template <class T>
std::vector<float> read(const TextureView& texture, int layer, const Transfer& transfer) {
    const glm::ivec3 size = texture.desc.size;
    std::vector<T> raw(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                       static_cast<std::size_t>(transfer.channels));
    glGetTextureSubImage(texture.id, 0, 0, 0, layer, size.x, size.y, 1, transfer.format, transfer.type,
                         static_cast<GLsizei>(raw.size() * sizeof(T)), raw.data());
    if constexpr (std::is_same_v<T, float>)
        return raw;
    else
        return {raw.begin(), raw.end()};
}

}  // namespace

Image read_texture(const TextureView& texture, int layer) {
    TYNDALL_CHECK(texture);
    // Shaders may have written it, and this is not a pass of a list that would derive the barrier.
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    reset_pack_state();
    const Transfer transfer = transfer_of(texture.id);
    Image image({texture.desc.size.x, texture.desc.size.y}, transfer.channels);
    if (transfer.type == GL_UNSIGNED_INT)
        image.pixels = read<GLuint>(texture, layer, transfer);
    else if (transfer.type == GL_INT)
        image.pixels = read<GLint>(texture, layer, transfer);
    else
        image.pixels = read<float>(texture, layer, transfer);

    for (int y = 0; y < image.size.y / 2; ++y)
        std::swap_ranges(image.at(0, y), image.at(0, y) + image.size.x * image.channels,
                         image.at(0, image.size.y - 1 - y));
    return image;
}

}  // namespace tyndall::gl
