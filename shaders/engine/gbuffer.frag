// glTF 2.0 metallic-roughness material to the G-buffer.
#include "shaders/engine/material.glsl"
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/octahedral.glsl"
#include "shaders/lib/pack.glsl"

layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec4 out_material;  // roughness, metallic, occlusion, dielectric f0 / BRDF_F0_STORED
layout(location = 3) out vec4 out_emissive;  // radiance
#if MOTION
layout(location = 4) in vec3 clip_now;
layout(location = 5) in vec3 clip_before;
layout(location = 4) out vec2 out_motion;  // uv now less uv in the frame before

// Where it was behind the camera, or farther away than the picture is wide: 2, which leads out of the picture.
vec2 motion() {
    if (clip_before.z <= 0.0) return vec2(2.0);
    vec2 ndc = clip_now.xy / clip_now.z - clip_before.xy / clip_before.z;
    return round_to_half(vec4(clamp(0.5 * ndc, vec2(-2.0), vec2(2.0)), 0.0, 0.0)).xy;
}
#endif

void main() {
    vec4 base_color = material_base_color();
#if ALPHA_MASK
    if (base_color.a < emissive_alpha_cutoff.a) discard;
#endif
    out_albedo = vec4(base_color.rgb, 1.0);
    out_normal = octahedral_encode(material_normal());
    out_material = vec4(material_roughness_metallic(), material_occlusion(), dielectric_f0 / BRDF_F0_STORED);
    out_emissive = vec4(material_emissive(), 0.0);
#if MOTION
    out_motion = motion();
#endif
}
