#include "engine/gl/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/gl/debug_scope.h"

namespace tyndall::gl {
namespace {

struct Format {
    GLenum format;
    std::size_t bytes;  ///< a texel, as drivers store it
    bool integer = false;
    bool depth = false;
};
constexpr Format formats[] = {
    {GL_R8, 1},
    {GL_R8_SNORM, 1},
    {GL_RG8, 2},
    {GL_RG8_SNORM, 2},
    {GL_RGB8, 4},
    {GL_SRGB8, 4},
    {GL_RGBA8, 4},
    {GL_RGBA8_SNORM, 4},
    {GL_SRGB8_ALPHA8, 4},
    {GL_RGB10_A2, 4},
    {GL_R16, 2},
    {GL_RG16, 4},
    {GL_RG16_SNORM, 4},
    {GL_RGBA16, 8},
    {GL_RGBA16_SNORM, 8},
    {GL_R16F, 2},
    {GL_RG16F, 4},
    {GL_RGB16F, 8},
    {GL_RGBA16F, 8},
    {GL_R32F, 4},
    {GL_RG32F, 8},
    {GL_RGB32F, 12},
    {GL_RGBA32F, 16},
    {GL_R11F_G11F_B10F, 4},
    {GL_RGB9_E5, 4},
    {GL_R8I, 1, true},
    {GL_R8UI, 1, true},
    {GL_RG8UI, 2, true},
    {GL_RGBA8UI, 4, true},
    {GL_R16I, 2, true},
    {GL_R16UI, 2, true},
    {GL_RG16UI, 4, true},
    {GL_RGBA16UI, 8, true},
    {GL_R32I, 4, true},
    {GL_R32UI, 4, true},
    {GL_RG32I, 8, true},
    {GL_RG32UI, 8, true},
    {GL_RGBA32I, 16, true},
    {GL_RGBA32UI, 16, true},
    {GL_DEPTH_COMPONENT16, 2, false, true},
    {GL_DEPTH_COMPONENT24, 4, false, true},
    {GL_DEPTH_COMPONENT32F, 4, false, true},
    {GL_DEPTH24_STENCIL8, 4, false, true},
    {GL_DEPTH32F_STENCIL8, 8, false, true},
};

const Format& format_info(GLenum format) {
    const Format* found = std::ranges::find(formats, format, &Format::format);
    if (found == std::end(formats))
        detail::check_failed("format is a sized format of engine/gl/texture.cpp", fmt::format("0x{:x}", format),
                             __FILE__, __LINE__);
    return *found;
}

/// Images along z at `level` as GL counts them: slices, array layers, cube faces.
int layer_count(const TextureDesc& desc, int level) {
    switch (desc.kind) {
        case TextureKind::d2:
            return 1;
        case TextureKind::d3:
            return std::max(desc.size.z >> level, 1);
        case TextureKind::d2_array:
            return desc.size.z;
        case TextureKind::cube:
            return 6;
        case TextureKind::cube_array:
            return 6 * desc.size.z;
    }
    return 1;
}

glm::ivec2 level_size(const TextureDesc& desc, int level) {
    return {std::max(desc.size.x >> level, 1), std::max(desc.size.y >> level, 1)};
}

int limit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

void check_limits(const TextureDesc& desc, const std::string& label) {
    const bool volume = desc.kind == TextureKind::d3;
    const bool cube = desc.kind == TextureKind::cube || desc.kind == TextureKind::cube_array;
    const int extent =
        limit(volume ? GL_MAX_3D_TEXTURE_SIZE : (cube ? GL_MAX_CUBE_MAP_TEXTURE_SIZE : GL_MAX_TEXTURE_SIZE));
    const int layers = volume ? extent : limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
    const glm::ivec3 size = desc.size;
    const bool fits = std::min({size.x, size.y, size.z}) >= 1 && size.x <= extent && size.y <= extent &&
                      layer_count(desc, 0) <= layers;
    if (!fits)
        throw Error(fmt::format("texture '{}': size {}x{}x{} is outside 1..{} x 1..{} x 1..{}", label, size.x,
                                size.y, size.z, extent, extent, layers));
    if (cube) TYNDALL_CHECK_EQ(size.x, size.y);
    TYNDALL_CHECK_LE(desc.levels, with_all_levels({desc.kind, desc.format, size, 0}).levels);
}

void default_sampling(GLuint id, const TextureDesc& desc) {
    // Integer textures are incomplete with a linear filter, and an incomplete texture reads as black.
    const bool nearest = format_info(desc.format).integer;
    const GLint plain = nearest ? GL_NEAREST : GL_LINEAR;
    const GLint mipped = nearest ? GL_NEAREST_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR;
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, desc.levels > 1 ? mipped : plain);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, plain);
    for (GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(id, axis, GL_CLAMP_TO_EDGE);
}

/// Callers pass tightly packed memory.
void reset_unpack_state() {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS,
                        GL_UNPACK_SKIP_IMAGES})
        glPixelStorei(name, 0);
}

}  // namespace

GLenum gl_target(TextureKind kind) {
    switch (kind) {
        case TextureKind::d2:
            return GL_TEXTURE_2D;
        case TextureKind::d2_array:
            return GL_TEXTURE_2D_ARRAY;
        case TextureKind::d3:
            return GL_TEXTURE_3D;
        case TextureKind::cube:
            return GL_TEXTURE_CUBE_MAP;
        case TextureKind::cube_array:
            return GL_TEXTURE_CUBE_MAP_ARRAY;
    }
    return GL_TEXTURE_2D;
}

int mip_count(glm::ivec3 size) {
    return std::bit_width(static_cast<unsigned>(std::max({size.x, size.y, size.z, 1})));
}

TextureDesc with_all_levels(TextureDesc desc) {
    if (desc.levels == 0)
        desc.levels = mip_count(desc.kind == TextureKind::d3 ? desc.size : glm::ivec3(desc.size.x, desc.size.y, 1));
    return desc;
}

std::size_t byte_size(const TextureDesc& desc) {
    std::size_t texels = 0;
    for (int level = 0; level < with_all_levels(desc).levels; ++level) {
        const glm::ivec2 size = level_size(desc, level);
        texels += static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                  static_cast<std::size_t>(layer_count(desc, level));
    }
    return texels * format_info(desc.format).bytes;
}

Texture::Texture(const TextureDesc& desc, const std::string& label) : desc_(with_all_levels(desc)) {
    check_limits(desc_, label);
    GLuint id = 0;
    glCreateTextures(gl_target(desc_.kind), 1, &id);
    handle_ = Handle<Traits>(id);
    gl::label(GL_TEXTURE, id, label);
    const glm::ivec3 s = desc_.size;
    if (desc_.kind == TextureKind::d2 || desc_.kind == TextureKind::cube)
        glTextureStorage2D(id, desc_.levels, desc_.format, s.x, s.y);
    else
        glTextureStorage3D(id, desc_.levels, desc_.format, s.x, s.y, layer_count(desc_, 0));
    default_sampling(id, desc_);
}

void Texture::upload(int level, GLenum pixel_format, GLenum type, const void* data) {
    reset_unpack_state();
    const glm::ivec2 size = level_size(desc_, level);
    if (desc_.kind == TextureKind::d2)
        glTextureSubImage2D(id(), level, 0, 0, size.x, size.y, pixel_format, type, data);
    else
        glTextureSubImage3D(id(), level, 0, 0, 0, size.x, size.y, layer_count(desc_, level), pixel_format, type,
                            data);
}

void Texture::upload_layer(int level, int layer, GLenum pixel_format, GLenum type, const void* data) {
    TYNDALL_CHECK_LT(layer, layer_count(desc_, level));
    if (desc_.kind == TextureKind::d2) return upload(level, pixel_format, type, data);
    reset_unpack_state();
    const glm::ivec2 size = level_size(desc_, level);
    glTextureSubImage3D(id(), level, 0, 0, layer, size.x, size.y, 1, pixel_format, type, data);
}

void Texture::generate_mipmaps() {
    glGenerateTextureMipmap(id());
}

void Texture::clear_float(float r, float g, float b, float a) {
    const Format& format = format_info(desc_.format);
    TYNDALL_CHECK(!format.integer);
    const float value[] = {r, g, b, a};
    for (int level = 0; level < desc_.levels; ++level)
        glClearTexImage(id(), level, format.depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, value);
}

}  // namespace tyndall::gl
