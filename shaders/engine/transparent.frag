// Transparent surfaces, shaded as lighting.frag shades the G-buffer's and fogged at their own depth. Alpha is the share of
// the surface that is there: diffuse and emitted light scale with it, the reflection of a smooth boundary such as glass does
// not. What transmits light does not scatter it. What is seen through the surface is filtered as light is (glass_filter).
#include "shaders/engine/glass_filter.glsl"
#include "shaders/engine/material.glsl"
#include "shaders/engine/transparent_blend.glsl"
#include "shaders/engine/surface_shading.glsl"

layout(location = 0, index = 0) out vec4 color;
layout(location = 0, index = 1) out vec4 through;

void main() {
    vec4 base_color = material_base_color();
    float alpha = clamp(base_color.a, 0.0, 1.0);
    vec2 roughness_metallic = material_roughness_metallic();
    Surface s;
    s.uv = gl_FragCoord.xy * frame.viewport.zw;
    vec4 world = frame.inverse_view_projection * vec4(s.uv * 2.0 - 1.0, gl_FragCoord.z, 1.0);
    s.world = world.xyz / world.w;
    s.normal = material_normal();
    s.to_eye = normalize(frame.eye.xyz - s.world);
    s.view_depth = view_depth_from_buffer(gl_FragCoord.z, frame.depth.x);
    s.base_color = clamp(base_color.rgb, 0.0, 1.0);
    s.roughness = clamp(roughness_metallic.x, 0.0, 1.0);
    s.metallic = clamp(roughness_metallic.y, 0.0, 1.0);
    s.occlusion = clamp(material_occlusion(), 0.0, 1.0);
    s.dielectric_f0 = min(dielectric_f0, BRDF_F0_STORED);
    Reflected light = surface_light(s);
    vec3 radiance = alpha * ((1.0 - transmission) * light.diffuse + material_emissive()) + light.specular;
    Blended surface = blended(radiance, 1.0 - glass_filter(base_color), s.uv, s.view_depth);
    color = vec4(surface.color, 0.0);
    through = vec4(1.0 - surface.hidden, 0.0);
    flush_work();
}
