#include "engine/render/gpu_scene.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/core/check.h"
#include "engine/render/alpha_coverage.h"
#include "shaders/shared/bindings.h"

namespace tyndall {
namespace {

static_assert(sizeof(Vertex) == 64, "interleaved as the attributes below say");

gl::Texture one_texel(std::array<std::uint8_t, 4> rgba, const std::string& label) {
    gl::Texture texture({gl::TextureKind::d2, GL_RGBA8, {1, 1, 1}, 1}, label);
    texture.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    return texture;
}

void set_sampling(GLuint texture, const Sampling& sampling, float anisotropy) {
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, static_cast<GLint>(sampling.u));
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, static_cast<GLint>(sampling.v));
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, sampling.nearest ? GL_NEAREST : GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(sampling.minification));
    const bool trilinear = sampling.minification == GL_LINEAR_MIPMAP_LINEAR && !sampling.nearest;
    if (!trilinear || GLAD_GL_EXT_texture_filter_anisotropic == 0) return;
    float most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    glTextureParameterf(texture, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(most, anisotropy));
}

/// Gives every mip level of a cut-out the coverage of the full picture. sRGB texels are read and written as stored.
void preserve_coverage(gl::Texture& texture, const Picture& picture, float cutoff) {
    const float coverage = alpha_coverage(picture.rgba, cutoff);
    glm::ivec2 size = picture.size;
    std::vector<std::uint8_t> level_texels;
    for (int level = 1; level < texture.desc().levels; ++level) {
        size = glm::max(size / 2, glm::ivec2(1));
        level_texels.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4);
        glGetTextureImage(texture.id(), level, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(level_texels.size()),
                          level_texels.data());
        scale_alpha_to_coverage(level_texels, cutoff, coverage);
        texture.upload(level, GL_RGBA, GL_UNSIGNED_BYTE, level_texels.data());
    }
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, float anisotropy)
    : anisotropy_(anisotropy),
      white_(one_texel({255, 255, 255, 255}, "neutral white")),
      flat_normal_(one_texel({128, 128, 255, 255}, "neutral normal")) {
    upload_meshes(scene);
    upload_materials(scene);
    place_instances(scene);
}

void GpuScene::upload_meshes(const Scene& scene) {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    for (const Mesh& mesh : scene.meshes) {
        ranges_.push_back({static_cast<std::uint32_t>(indices.size()),
                           static_cast<std::uint32_t>(mesh.indices.size()),
                           static_cast<std::int32_t>(vertices.size())});
        vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    vertices_ = gl::Buffer::of(std::span<const Vertex>(vertices), "scene vertices");
    indices_ = gl::Buffer::of(std::span<const std::uint32_t>(indices), "scene indices");

    vertex_array_ = gl::VertexArray("scene");
    vertex_array_.vertex_buffer(0, vertices_.id(), 0, sizeof(Vertex));
    vertex_array_.attribute(0, 0, 3, GL_FLOAT, offsetof(Vertex, position));
    vertex_array_.attribute(1, 0, 3, GL_FLOAT, offsetof(Vertex, normal));
    vertex_array_.attribute(2, 0, 4, GL_FLOAT, offsetof(Vertex, tangent));
    vertex_array_.attribute(3, 0, 2, GL_FLOAT, offsetof(Vertex, uv));
    vertex_array_.attribute(4, 0, 4, GL_FLOAT, offsetof(Vertex, color));
    for (GLuint row = 0; row < 3; ++row)
        vertex_array_.attribute(5 + row, 1, 4, GL_FLOAT, row * static_cast<GLuint>(sizeof(glm::vec4)));
    vertex_array_.integer_attribute(8, 1, 1, GL_UNSIGNED_INT, offsetof(DrawnInstance, instance));
    vertex_array_.index_buffer(indices_.id());
}

GLuint GpuScene::texture(const Scene& scene, int picture_index, bool srgb, float coverage_cutoff) {
    const auto [entry, added] = textures_.try_emplace({picture_index, srgb, coverage_cutoff});
    gl::Texture& texture = entry->second;
    if (added) {
        const Picture& picture = scene.pictures[static_cast<std::size_t>(picture_index)];
        const GLenum format = srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8;
        texture = gl::Texture({gl::TextureKind::d2, format, {picture.size.x, picture.size.y, 1}, 0},
                              "picture " + picture.name + (srgb ? " (sRGB)" : " (linear)"));
        texture.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
        texture.generate_mipmaps();
        if (coverage_cutoff > 0) preserve_coverage(texture, picture, coverage_cutoff);
        set_sampling(texture.id(), picture.sampling, anisotropy_);
    }
    return texture.id();
}

void GpuScene::upload_materials(const Scene& scene) {
    for (const Material& from : scene.materials) {
        const auto slot = [&](int picture, bool srgb, const gl::Texture& neutral, float cutoff = 0) {
            return picture < 0 ? neutral.id() : texture(scene, picture, srgb, cutoff);
        };
        // The picture's alpha that the cutoff means: base colour's alpha factor multiplies it.
        const float cutoff =
            from.alpha_mask && from.base_color.a > 0 ? from.alpha_cutoff / from.base_color.a : 0.0f;
        materials_.push_back({
            .base_color = slot(from.base_color_picture, true, white_, cutoff),
            .metallic_roughness = slot(from.metallic_roughness_picture, false, white_),
            .normal = slot(from.normal_picture, false, flat_normal_),
            .occlusion = slot(from.occlusion_picture, false, white_),
            .emissive = slot(from.emissive_picture, true, white_),
            .base_color_factor = from.base_color,
            .emissive_alpha_cutoff = glm::vec4(from.emissive, from.alpha_mask ? from.alpha_cutoff : -1.0f),
            .metallic_roughness_normal_occlusion =
                glm::vec4(from.metallic, from.roughness, from.normal_scale, from.occlusion_strength),
            .dielectric_f0 = from.dielectric_f0,
            .transmission = from.transmission,
            .alpha_mask = from.alpha_mask,
            .alpha_blend = from.alpha_blend,
            .double_sided = from.double_sided,
        });
    }
}

void GpuScene::place_instances(const Scene& scene) {
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        for (const int mesh : node.meshes) {
            const Mesh& from = scene.meshes[static_cast<std::size_t>(mesh)];
            if (from.indices.empty()) continue;
            instances_.push_back({mesh, from.material, static_cast<int>(n), node.cast_shadow, node.dynamic,
                                  transformed(from.bounds, node.world), mirrors(node.world)});
        }
    }
    std::ranges::stable_sort(instances_, {},
                             [](const Instance& i) { return std::tuple(i.material, i.mirrored, i.mesh); });
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        models_.push_back(scene.nodes[static_cast<std::size_t>(instances_[i].node)].world);
        if (instances_[i].dynamic) dynamic_.push_back(static_cast<int>(i));
    }
    previous_models_ = models_;
}

void GpuScene::update(const Scene& scene) {
    if (dynamic_.empty()) return;
    for (const int index : dynamic_) {
        Instance& instance = instances_[static_cast<std::size_t>(index)];
        const glm::mat4& world = scene.nodes[static_cast<std::size_t>(instance.node)].world;
        glm::mat4& model = models_[static_cast<std::size_t>(index)];
        previous_models_[static_cast<std::size_t>(index)] = std::exchange(model, world);
        instance.bounds = transformed(scene.meshes[static_cast<std::size_t>(instance.mesh)].bounds, world);
        instance.mirrored = mirrors(world);
    }
}

bool GpuScene::has_moved(const Frustum& frustum) const {
    return std::ranges::any_of(dynamic_, [&](int index) {
        const auto i = static_cast<std::size_t>(index);
        return models_[i] != previous_models_[i] && !materials_[instances_[i].material].alpha_blend &&
               frustum.intersects(instances_[i].bounds);
    });
}

void GpuScene::bind_previous() {
    if (!previous_transforms_)
        previous_transforms_ =
            gl::Buffer::of(std::span<const glm::mat4>(previous_models_), "previous instance transforms");
    else if (!dynamic_.empty()) {
        // From the first to the last dynamic one: fewer calls matter more than the bytes between.
        const auto first = static_cast<std::size_t>(dynamic_.front()),
                   last = static_cast<std::size_t>(dynamic_.back());
        previous_transforms_.write(first * sizeof(glm::mat4), (last - first + 1) * sizeof(glm::mat4),
                                   &previous_models_[first]);
    }
    previous_transforms_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_PREVIOUS_INSTANCES);
}

void GpuScene::bind(const gl::Buffer& drawn) const {
    vertex_array_.vertex_buffer(1, drawn.id(), 0, sizeof(DrawnInstance), 1);
    vertex_array_.bind();
}

bool GpuScene::has_dynamic_caster(const Frustum& frustum) const {
    return std::ranges::any_of(dynamic_, [&](int index) {
        const Instance& instance = instances_[static_cast<std::size_t>(index)];
        return instance.cast_shadow && frustum.intersects(instance.bounds);
    });
}

}  // namespace tyndall
