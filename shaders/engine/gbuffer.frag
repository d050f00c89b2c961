// glTF 2.0 metallic-roughness material to the G-buffer.
#include "shaders/engine/material.glsl"
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/octahedral.glsl"

layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec4 out_material;  // roughness, metallic, occlusion, dielectric f0 / BRDF_F0_STORED
layout(location = 3) out vec4 out_emissive;  // cd/m²

void main() {
    vec4 base_color = material_base_color();
#if ALPHA_MASK
    if (base_color.a < emissive_alpha_cutoff.a) discard;
#endif
    out_albedo = vec4(base_color.rgb, 1.0);
    out_normal = octahedral_encode(material_normal());
    out_material = vec4(material_roughness_metallic(), material_occlusion(), dielectric_f0 / BRDF_F0_STORED);
    out_emissive = vec4(material_emissive(), 0.0);
}
