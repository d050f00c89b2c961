#include "engine/render/passes/material_binding.h"

#include <array>

namespace tyndall {

void bind_material(const gl::Program& shader, const GpuScene::GpuMaterial& material, bool mirrored,
                   float light_unit) {
    const std::array<GLuint, 5> textures{material.base_color, material.metallic_roughness, material.normal,
                                         material.occlusion, material.emissive};
    glBindTextures(0, static_cast<GLsizei>(textures.size()), textures.data());
    shader.set("base_color_factor", material.base_color_factor);
    shader.set("emissive_alpha_cutoff",
               glm::vec4(glm::vec3(material.emissive_alpha_cutoff) / light_unit, material.emissive_alpha_cutoff.a));
    shader.set("metallic_roughness_normal_occlusion", material.metallic_roughness_normal_occlusion);
    shader.set("dielectric_f0", material.dielectric_f0);
    shader.set("handedness", mirrored ? -1.0f : 1.0f);
    shader.use();
}

}  // namespace tyndall
