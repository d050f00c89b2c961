// Deferred shading: emission, sun, clustered lamps and sky on the surfaces of the G-buffer. Linear radiance, cd/m².
#include "shaders/engine/light_data.glsl"
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/depth.glsl"
#include "shaders/lib/lamp_segment.glsl"
#include "shaders/lib/octahedral.glsl"
#include "shaders/lib/work.glsl"
#if SHADOWS
#include "shaders/engine/shadow_lookup.glsl"
#endif
#if MEDIUM_TRANSMITTANCE
#include "shaders/volumetrics/light_transmittance.glsl"
#endif

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

layout(binding = 0) uniform sampler2D albedo_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 2) uniform sampler2D material_texture;
layout(binding = 3) uniform sampler2D emissive_texture;
layout(binding = 4) uniform sampler2D depth_texture;
layout(binding = 5) uniform samplerCube sky;  // radiance, mipped

struct Surface {
    vec3 world, normal, to_eye;
    float view_depth;
    vec3 base_color;
    float roughness, metallic, occlusion, dielectric_f0;
};

Surface surface_at(ivec2 pixel) {
    float depth = texelFetch(depth_texture, pixel, 0).r;
    vec4 world = frame.inverse_view_projection * vec4(uv * 2.0 - 1.0, depth, 1.0);
    vec4 material = texelFetch(material_texture, pixel, 0);
    Surface s;
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

vec3 reflected(Surface s, vec3 to_light) {
    return brdf_metallic_roughness(s.base_color, s.metallic, s.roughness, s.dielectric_f0, s.normal, s.to_eye,
                                   to_light) *
           max(dot(s.normal, to_light), 0.0);
}

#if HAS_SUN
vec3 sun_light(Surface s) {
    vec3 to_sun = -frame.sun_direction.xyz;
    vec3 illuminance = frame.sun_illuminance.rgb;
#if SHADOWS
    illuminance *= sun_shadow_surface(s.world, s.normal, s.view_depth);
#endif
#if MEDIUM_TRANSMITTANCE
    illuminance *= medium_light_transmittance(s.world, to_sun, -1.0);
#endif
    count_work(WORK_LIGHT_EVALUATIONS, 1u);
    return reflected(s, to_sun) * illuminance;
}
#endif

#if HAS_LAMPS
vec3 lamp_light(Surface s) {
    ClusterRange range = cluster_at(uv, s.view_depth);
    count_work(WORK_LIGHT_EVALUATIONS, range.count);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < range.count; ++i) {
        GpuLight light = lights[cluster_lights[range.offset + i]];
        vec3 offset = light.position_range.xyz - s.world;
        float d2 = dot(offset, offset);
        float d = sqrt(d2);
        vec3 to_light = offset / max(d, 1e-6);
        float attenuation = lamp_attenuation(d2, light.intensity_radius.w, 1.0 / light.position_range.w) *
                            spot_cone(-dot(to_light, light.direction_type.xyz), light.cone_shadow.xy);
        if (attenuation <= 0.0 || dot(s.normal, to_light) <= 0.0) continue;
        vec3 illuminance = light.intensity_radius.rgb * attenuation;
#if SHADOWS
        illuminance *= light_shadow_surface(light, s.world, s.normal);
#endif
#if MEDIUM_TRANSMITTANCE
        illuminance *= medium_light_transmittance(s.world, to_light, d);
#endif
        sum += reflected(s, to_light) * illuminance;
    }
    return sum;
}
#endif

#if HAS_AMBIENT
// The mip that blurs the sky about as much as the lobe: with a box filter each level doubles the angle a texel spans.
vec3 ambient_light(Surface s) {
    float n_dot_v = min(abs(dot(s.normal, s.to_eye)), 1.0);
    vec3 f0 = mix(vec3(s.dielectric_f0), s.base_color, s.metallic);
    vec2 scale = specular_albedo_scale(s.roughness, n_dot_v);
    vec3 specular = f0 * scale.x + brdf_f90(s.dielectric_f0, s.metallic) * scale.y;
    vec3 diffuse = (1.0 - specular) * (1.0 - s.metallic) * s.base_color;
    float levels = float(textureQueryLevels(sky) - 1);
    float level = levels * sqrt(s.roughness) * 0.9;
    vec3 mirrored = textureLod(sky, reflect(-s.to_eye, s.normal), level).rgb;
    // A rough lobe sees what the occlusion lets through, a sharp one less of it (Lagarde and de Rousiers 2014, 4.10).
    float specular_occlusion =
        clamp(pow(n_dot_v + s.occlusion, exp2(-16.0 * s.roughness - 1.0)) - 1.0 + s.occlusion, 0.0, 1.0);
    vec3 light = diffuse * textureLod(ambient_cube, s.normal, 0.0).rgb * s.occlusion +
                 specular * mirrored * specular_occlusion;
    return light * frame.exposure.y;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface s = surface_at(pixel);
    vec3 radiance = texelFetch(emissive_texture, pixel, 0).rgb;
#if HAS_SUN
    radiance += sun_light(s);
#endif
#if HAS_LAMPS
    radiance += lamp_light(s);
#endif
#if HAS_AMBIENT
    radiance += ambient_light(s);
#endif
    color = vec4(min(radiance, vec3(65000.0)), 1.0);
    flush_work();
}
