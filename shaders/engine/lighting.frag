// Deferred shading: emission, sun, clustered lamps and sky on the surfaces of the G-buffer. Linear radiance, cd/m².
#include "shaders/engine/surface_shading.glsl"
#include "shaders/lib/octahedral.glsl"

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

layout(binding = 0) uniform sampler2D albedo_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 2) uniform sampler2D material_texture;
layout(binding = 3) uniform sampler2D emissive_texture;
layout(binding = 4) uniform sampler2D depth_texture;

Surface surface_at(ivec2 pixel) {
    float depth = texelFetch(depth_texture, pixel, 0).r;
    vec4 world = frame.inverse_view_projection * vec4(uv * 2.0 - 1.0, depth, 1.0);
    vec4 material = texelFetch(material_texture, pixel, 0);
    Surface s;
    s.uv = uv;
    s.world = world.xyz / world.w;
    s.normal = octahedral_decode(texelFetch(normal_texture, pixel, 0).rg);
    s.to_eye = normalize(frame.eye.xyz - s.world);
    s.view_depth = view_depth_from_buffer(depth, frame.depth.x);
    s.base_color = texelFetch(albedo_texture, pixel, 0).rgb;
    s.roughness = material.r;
    s.metallic = material.g;
    s.occlusion = material.b;
    s.dielectric_f0 = material.a * BRDF_F0_STORED;
    return s;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Reflected light = surface_light(surface_at(pixel));
    vec3 radiance = texelFetch(emissive_texture, pixel, 0).rgb + light.diffuse + light.specular;
    color = vec4(min(radiance, vec3(65000.0)), 1.0);
    flush_work();
}
