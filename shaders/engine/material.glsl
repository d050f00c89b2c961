// glTF 2.0 metallic-roughness material of the fragment that gbuffer.vert's triangle covers.
#ifndef ENGINE_MATERIAL_GLSL
#define ENGINE_MATERIAL_GLSL

layout(location = 0) in vec3 world_normal;
layout(location = 1) in vec4 world_tangent;
layout(location = 2) in vec2 uv;
layout(location = 3) flat in float handedness;

layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D metallic_roughness_texture;
layout(binding = 2) uniform sampler2D normal_texture;
layout(binding = 3) uniform sampler2D occlusion_texture;
layout(binding = 4) uniform sampler2D emissive_texture;

uniform vec4 base_color_factor;
uniform vec4 emissive_alpha_cutoff;
uniform vec4 metallic_roughness_normal_occlusion;
uniform float dielectric_f0;

vec4 material_base_color() { return texture(base_color_texture, uv) * base_color_factor; }

vec2 material_roughness_metallic() {
    return texture(metallic_roughness_texture, uv).gb * metallic_roughness_normal_occlusion.yx;
}

float material_occlusion() {
    return 1.0 + metallic_roughness_normal_occlusion.w * (texture(occlusion_texture, uv).r - 1.0);
}

// cd/m²
vec3 material_emissive() {
    return min(texture(emissive_texture, uv).rgb * emissive_alpha_cutoff.rgb, vec3(65000.0));
}

// World space, unit. Two-sided surfaces show the back with its normal reversed; a mirrored instance has its faces wound
// backwards.
vec3 material_normal() {
    float side = gl_FrontFacing == (handedness > 0.0) ? 1.0 : -1.0;
    vec3 n = normalize(world_normal);
    // 8 bits hold no 0.5: 128 is what everybody writes for a flat surface, so that is made exactly flat.
    vec3 bump = texture(normal_texture, uv).xyz * (255.0 / 127.0) - 128.0 / 127.0;
    bump.xy *= metallic_roughness_normal_occlusion.z;
    vec3 t = world_tangent.xyz - n * dot(n, world_tangent.xyz);
    float t_length = length(t);
    if (t_length > 1e-6) {
        t /= t_length;
        n = normalize(bump.x * t + bump.y * world_tangent.w * cross(n, t) + bump.z * n);
    }
    return side * n;
}

#endif
