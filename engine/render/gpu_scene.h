#pragma once

#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "engine/gl/buffer.h"
#include "engine/gl/texture.h"
#include "engine/gl/vertex_array.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"

namespace tyndall {

/// One mesh placed in the world. Sorted by material, then as mirrored or not, then mesh, so that equal meshes draw
/// instanced.
struct Instance {
    int mesh;
    int material;
    int node;
    bool cast_shadow;
    bool dynamic;
    Aabb bounds;    ///< world
    bool mirrored;  ///< its front faces are wound clockwise
};

/// The scene on the GPU: one vertex and one index buffer, a texture per picture and colour space, transforms per
/// instance. Textures carry their own sampling (the picture's; anisotropic where that is trilinear): bind them with
/// sampler 0. Those of masked materials keep their coverage at every mip level, so that foliage does not thin out
/// with distance.
class GpuScene {
  public:
    /// Throws Error for a picture larger than the driver's limit.
    /// `anisotropy` of the material textures' filter, 1 to the driver's limit.
    explicit GpuScene(const Scene& scene, float anisotropy = 4);
    /// Refreshes dynamic instances: transforms, bounds, and whether they are mirrored. Once a frame: the transforms
    /// before are kept.
    void update(const Scene& scene);
    /// Something opaque whose bounds meet `frustum` had another transform at the update before.
    [[nodiscard]] bool has_moved(const Frustum& frustum) const;

    [[nodiscard]] std::span<const Instance> instances() const { return instances_; }
    struct MeshRange {
        std::uint32_t first_index, index_count;
        std::int32_t base_vertex;
    };
    [[nodiscard]] const MeshRange& range(int mesh) const { return ranges_[mesh]; }
    struct GpuMaterial {
        GLuint base_color = 0, metallic_roughness = 0, normal = 0, occlusion = 0,
               emissive = 0;  ///< texture names, never 0: neutral 1x1 where absent
        glm::vec4 base_color_factor;
        glm::vec4 emissive_alpha_cutoff;                ///< rgb cd/m², a cutoff (< 0: opaque)
        glm::vec4 metallic_roughness_normal_occlusion;  ///< factors
        float dielectric_f0, transmission;
        bool alpha_mask, alpha_blend, double_sided;
    };
    [[nodiscard]] const GpuMaterial& material(int index) const { return materials_[index]; }

    /// What a draw reads of an instance: once for all of its vertices, where a storage buffer would be read at
    /// each.
    struct DrawnInstance {
        glm::mat3x4 model_rows;  ///< rows of the affine model matrix
        std::uint32_t instance;  ///< index into instances()
    };
    [[nodiscard]] DrawnInstance drawn(std::size_t instance) const {
        return {glm::transpose(glm::mat4x3(models_[instance])), static_cast<std::uint32_t>(instance)};
    }
    /// Attribute 0 position, 1 normal, 2 tangent, 3 uv, 4 colour; of each instance, from the draw's base instance
    /// on: 5 to 7 model_rows, 8 its index. `drawn` holds DrawnInstances.
    void bind(const gl::Buffer& drawn) const;
    /// The transforms at the update before, mat4 per instance in the order of instances(), at
    /// BINDING_PREVIOUS_INSTANCES. Uploads them.
    void bind_previous();
    /// True when a dynamic shadow caster whose bounds meet `frustum` exists.
    [[nodiscard]] bool has_dynamic_caster(const Frustum& frustum) const;

  private:
    [[nodiscard]] GLuint texture(const Scene& scene, int picture, bool srgb, float coverage_cutoff);
    void upload_meshes(const Scene& scene);
    void upload_materials(const Scene& scene);
    void place_instances(const Scene& scene);

    float anisotropy_;
    std::vector<Instance> instances_;
    std::vector<int> dynamic_;  ///< indices into instances_, ascending
    std::vector<glm::mat4> models_, previous_models_;
    std::vector<MeshRange> ranges_;
    std::vector<GpuMaterial> materials_;
    std::map<std::tuple<int, bool, float>, gl::Texture> textures_;  ///< by picture, sRGB, alpha cutoff (0: none)
    gl::Texture white_, flat_normal_;
    gl::Buffer vertices_, indices_;
    gl::Buffer previous_transforms_;  ///< from the first bind_previous on
    gl::VertexArray vertex_array_;
};

}  // namespace tyndall
