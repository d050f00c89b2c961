// Light that a surface sends to the eye, deferred and forward alike: sun, clustered lamps and sky. Linear radiance.
// Diffuse and specular apart: glass lets the one through and not the other.
#ifndef ENGINE_SURFACE_SHADING_GLSL
#define ENGINE_SURFACE_SHADING_GLSL

#include "shaders/engine/light_data.glsl"
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/depth.glsl"
#include "shaders/lib/lamp_segment.glsl"
#include "shaders/lib/octahedral.glsl"
#include "shaders/lib/work.glsl"
#ifndef GLASS
#define GLASS 0
#endif
#if SHADOWS
#include "shaders/engine/glass_lookup.glsl"
#include "shaders/engine/shadow_lookup.glsl"
#endif
#if MEDIUM_TRANSMITTANCE
#include "shaders/volumetrics/light/light_transmittance.glsl"
#endif

layout(binding = 5) uniform samplerCube sky;  // radiance, mipped

struct Surface {
    vec2 uv;  // on the screen, 0..1
    vec3 world, normal, to_eye;
    float view_depth;
    vec3 base_color;
    float roughness, metallic, occlusion, dielectric_f0;
};

struct Reflected {
    vec3 diffuse;
    vec3 specular;
};

void add_light(Surface s, vec3 to_light, vec3 illuminance, inout Reflected sum) {
    BrdfLobes lobes = brdf_lobes(s.base_color, s.metallic, s.roughness, s.dielectric_f0, s.normal, s.to_eye, to_light);
    illuminance *= max(dot(s.normal, to_light), 0.0);
    sum.diffuse += lobes.diffuse * illuminance;
    sum.specular += lobes.specular * illuminance;
}

#if HAS_SUN
void add_sun(Surface s, inout Reflected sum) {
    vec3 to_sun = -frame.sun_direction.xyz;
    vec3 illuminance = frame.sun_illuminance.rgb;
#if SHADOWS
    illuminance *= sun_shadow_surface(s.world, s.normal, s.view_depth);
#endif
#if GLASS
    illuminance *= sun_glass(s.world, s.view_depth);
#endif
#if MEDIUM_TRANSMITTANCE
    illuminance *= medium_sun_transmittance(s.world, to_sun);
#endif
    count_work(WORK_LIGHT_EVALUATIONS, 1u);
    add_light(s, to_sun, illuminance, sum);
}
#endif

#if HAS_LAMPS
// Share of a lamp's intensity that arrives unshadowed on the lit side of a surface, 1/m2.
float surface_lamp_share(Surface s, GpuLight light, out vec3 to_light, out float d) {
    vec3 offset = light.position_range.xyz - s.world;
    float d2 = dot(offset, offset);
    d = sqrt(d2);
    to_light = offset / max(d, 1e-6);
    float attenuation = lamp_attenuation(d2, light.intensity_radius.w, 1.0 / light.position_range.w) *
                        spot_cone(-dot(to_light, light.direction_type.xyz), light.cone_shadow.xy);
    return dot(s.normal, to_light) > 0.0 ? attenuation : 0.0;
}

// Of each 32 lamps those that light the surface are found first: neighbouring pixels, which run together, then look up the
// shadows of as many lamps as light one of them, not of all that are listed.
void add_lamps(Surface s, inout Reflected sum) {
    ClusterRange range = cluster_at(s.uv, s.view_depth);
    count_work(WORK_LIGHT_EVALUATIONS, range.count);
    for (uint first = 0u; first < range.count; first += 32u) {
        uint count = min(range.count - first, 32u);
        uint reaching = 0u;
        vec3 to_light;
        float d;
        for (uint i = 0u; i < count; ++i) {
            GpuLight light = light_data(cluster_lights[range.offset + first + i]);
            if (surface_lamp_share(s, light, to_light, d) > 0.0) reaching |= 1u << i;
        }
        for (; reaching != 0u; reaching &= reaching - 1u) {
            uint index = cluster_lights[range.offset + first + uint(findLSB(reaching))];
            GpuLight light = light_data(index);
            vec3 illuminance = light.intensity_radius.rgb * surface_lamp_share(s, light, to_light, d);
#if SHADOWS
            illuminance *= light_shadow_surface(light, s.world, s.normal);
#endif
#if GLASS
            illuminance *= light_glass(light, s.world);
#endif
#if MEDIUM_TRANSMITTANCE
            illuminance *= medium_lamp_transmittance(index, s.world, to_light, d);
#endif
            add_light(s, to_light, illuminance, sum);
        }
    }
}
#endif

#if HAS_AMBIENT
#if SKY_VISIBILITY
// Share of the open sky that is seen round a direction, the rougher the wider.
float visible_sky(SkyRadiance here, vec3 direction, float roughness) {
    float g = mix(0.9, 0.5, roughness);
    vec3 open = sky_scattered(sky_radiance_open(), direction, g);
    vec3 seen = sky_scattered(here, direction, g);
    return min((seen.r + seen.g + seen.b) / max(open.r + open.g + open.b, 1.0e-30), 1.0);
}
#endif

// The mip that blurs the sky about as much as the lobe: with a box filter each level doubles the angle a texel spans.
void add_ambient(Surface s, inout Reflected sum) {
    if (frame.exposure.y <= 0.0) return;
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
#if SKY_VISIBILITY
    SkyRadiance here = sky_radiance_on(s.world, s.normal);
    mirrored *= frame.exposure.y * visible_sky(here, reflect(-s.to_eye, s.normal), s.roughness);
    vec3 irradiance = sky_irradiance(here, s.normal);  // over pi
#else
    mirrored *= frame.exposure.y;
    vec3 irradiance = textureLod(ambient_cube, s.normal, 0.0).rgb * frame.exposure.y;
#endif
    sum.diffuse += diffuse * irradiance * s.occlusion;
    sum.specular += specular * mirrored * specular_occlusion;
}
#endif

Reflected surface_light(Surface s) {
    Reflected sum = Reflected(vec3(0.0), vec3(0.0));
#if HAS_SUN
    add_sun(s, sum);
#endif
#if HAS_LAMPS
    add_lamps(s, sum);
#endif
#if HAS_AMBIENT
    add_ambient(s, sum);
#endif
    return sum;
}

#endif
