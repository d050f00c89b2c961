// glTF 2.0 metallic-roughness material of the fragment that gbuffer.vert's triangle covers.
#ifndef ENGINE_MATERIAL_GLSL
#define ENGINE_MATERIAL_GLSL

#include "shaders/engine/frame_block.glsl"

layout(location = 0) in vec3 world_normal;
layout(location = 1) in vec4 world_tangent;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 vertex_color;

layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D metallic_roughness_texture;
layout(binding = 2) uniform sampler2D normal_texture;
layout(binding = 3) uniform sampler2D occlusion_texture;
layout(binding = 4) uniform sampler2D emissive_texture;

uniform vec4 base_color_factor;
uniform vec4 emissive_alpha_cutoff;
uniform vec4 metallic_roughness_normal_occlusion;
uniform float dielectric_f0;

vec4 material_base_color() { return texture(base_color_texture, uv) * base_color_factor * vertex_color; }

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

// Of the triangle, unit, towards the eye.
vec3 material_face_normal() {
    vec3 ndc = vec3(gl_FragCoord.xy * frame.viewport.zw * 2.0 - 1.0, gl_FragCoord.z);
    vec4 world = frame.inverse_view_projection * vec4(ndc, 1.0);
    vec3 to_eye = frame.eye.xyz - world.xyz / world.w;
    vec3 n = cross(dFdx(to_eye), dFdy(to_eye));
    float size = length(n);
    return size > 0.0 ? n / (dot(n, to_eye) < 0.0 ? -size : size) : normalize(to_eye);
}

// World space, unit. Two-sided surfaces show the back with its normal reversed.
vec3 material_normal() {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 face = material_face_normal();
    float size = length(world_normal);
    // A transform that flattens leaves nothing but rounding of the normals that lie in its plane.
    vec3 n = size > 1.0e-6 ? world_normal / size : side * face;
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
