// glTF 2.0 metallic-roughness material to the G-buffer.
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/octahedral.glsl"

layout(location = 0) in vec3 world_normal;
layout(location = 1) in vec4 world_tangent;
layout(location = 2) in vec2 uv;
layout(location = 3) flat in float handedness;

layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec4 out_material;  // roughness, metallic, occlusion, dielectric f0 / BRDF_F0_STORED
layout(location = 3) out vec4 out_emissive;  // cd/m²

layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D metallic_roughness_texture;
layout(binding = 2) uniform sampler2D normal_texture;
layout(binding = 3) uniform sampler2D occlusion_texture;
layout(binding = 4) uniform sampler2D emissive_texture;

uniform vec4 base_color_factor;
uniform vec4 emissive_alpha_cutoff;
uniform vec4 metallic_roughness_normal_occlusion;
uniform float dielectric_f0;

void main() {
    vec4 base_color = texture(base_color_texture, uv) * base_color_factor;
#if ALPHA_MASK
    if (base_color.a < emissive_alpha_cutoff.a) discard;
#endif
    vec4 factors = metallic_roughness_normal_occlusion;
    vec2 roughness_metallic = texture(metallic_roughness_texture, uv).gb * factors.yx;
    float occlusion = 1.0 + factors.w * (texture(occlusion_texture, uv).r - 1.0);
    vec3 emissive = texture(emissive_texture, uv).rgb * emissive_alpha_cutoff.rgb;

    // Two-sided surfaces show the back with its normal reversed; a mirrored instance has its faces wound backwards.
    float side = gl_FrontFacing == (handedness > 0.0) ? 1.0 : -1.0;
    vec3 n = normalize(world_normal);
    // 8 bits hold no 0.5: 128 is what everybody writes for a flat surface, so that is made exactly flat.
    vec3 bump = texture(normal_texture, uv).xyz * (255.0 / 127.0) - 128.0 / 127.0;
    bump.xy *= factors.z;
    vec3 t = world_tangent.xyz - n * dot(n, world_tangent.xyz);
    float t_length = length(t);
    if (t_length > 1e-6) {
        t /= t_length;
        n = normalize(bump.x * t + bump.y * world_tangent.w * cross(n, t) + bump.z * n);
    }

    out_albedo = vec4(base_color.rgb, 1.0);
    out_normal = octahedral_encode(side * n);
    out_material = vec4(roughness_metallic, occlusion, dielectric_f0 / BRDF_F0_STORED);
    out_emissive = vec4(min(emissive, vec3(65000.0)), 0.0);
}
