#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "engine/gl/handle.h"

namespace tyndall::gl {

enum class TextureKind { d2, d2_array, d3, cube, cube_array };

/// Immutable storage. `size.z` is the depth of a 3D texture, the layers of an array, the cubes of a cube array;
/// 1 otherwise. `levels` 0 means a full mip chain.
struct TextureDesc {
    TextureKind kind = TextureKind::d2;
    GLenum format = GL_RGBA16F;  ///< sized internal format
    glm::ivec3 size{1};
    int levels = 1;
    friend bool operator==(const TextureDesc&, const TextureDesc&) = default;
};

/// Bytes of all levels and layers.
[[nodiscard]] std::size_t byte_size(const TextureDesc& desc);
/// Full mip chain length.
[[nodiscard]] int mip_count(glm::ivec3 size);
[[nodiscard]] GLenum gl_target(TextureKind kind);
/// `desc` with `levels` 0 replaced by the length of the full chain.
[[nodiscard]] TextureDesc with_all_levels(TextureDesc desc);

class Texture {
  public:
    Texture() = default;
    /// Allocates and labels; the content is undefined. Throws Error when the size exceeds the driver's limits.
    Texture(const TextureDesc& desc, const std::string& label);

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    explicit operator bool() const { return static_cast<bool>(handle_); }
    [[nodiscard]] const TextureDesc& desc() const { return desc_; }  ///< `levels` resolved, never 0
    [[nodiscard]] glm::ivec2 size() const { return {desc_.size.x, desc_.size.y}; }

    /// Uploads one level (all layers). `pixel_format`/`type` as in glTextureSubImage.
    void upload(int level, GLenum pixel_format, GLenum type, const void* data);
    /// Uploads one layer (array layer, cube face = layer, slice) of one level.
    void upload_layer(int level, int layer, GLenum pixel_format, GLenum type, const void* data);
    void generate_mipmaps();
    void clear_float(float r, float g, float b, float a);

  private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteTextures(1, &id); }
    };
    Handle<Traits> handle_;
    TextureDesc desc_;
};

/// Wraps nothing: a borrowed texture as passes see it (a host engine's name, or `Texture`).
struct TextureView {
    GLuint id = 0;
    TextureDesc desc;
    TextureView() = default;
    TextureView(GLuint id_, const TextureDesc& desc_) : id(id_), desc(desc_) {}
    TextureView(const Texture& t) : id(t.id()), desc(t.desc()) {}  // NOLINT: implicit on purpose
    explicit operator bool() const { return id != 0; }
};

}  // namespace tyndall::gl
