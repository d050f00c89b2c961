// Light that a point in the air scatters towards the eye where it scatters all of it, alike in all directions: the mean
// over the sphere of what arrives, sum E V / (4 pi) + ambient. Linear radiance.
#ifndef ENGINE_AIR_LIGHT_GLSL
#define ENGINE_AIR_LIGHT_GLSL

#include "shaders/engine/light_data.glsl"
#include "shaders/lib/lamp_segment.glsl"
#include "shaders/lib/work.glsl"
#if SHADOWS
#include "shaders/engine/shadow_lookup.glsl"
#endif
#if MEDIUM_TRANSMITTANCE
#include "shaders/volumetrics/light/light_transmittance.glsl"
#endif

const float ISOTROPIC_PHASE = 0.07957747;  // 1 / (4 pi)

#if HAS_SUN
vec3 air_sun(vec3 world, float view_depth) {
    vec3 illuminance = frame.sun_illuminance.rgb;
    count_work(WORK_LIGHT_EVALUATIONS, 1u);
#if SHADOWS
    count_work(WORK_SHADOW_LOOKUPS, 1u);
    illuminance *= sun_shadow_volume(world, view_depth);
#endif
#if MEDIUM_TRANSMITTANCE
    illuminance *= medium_sun_transmittance(world, -frame.sun_direction.xyz);
#endif
    return illuminance;
}
#endif

#if HAS_LAMPS
vec3 air_lamps(vec3 world, vec2 screen, float view_depth) {
    ClusterRange range = cluster_at(screen, view_depth);
    count_work(WORK_LIGHT_EVALUATIONS, range.count);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < range.count; ++i) {
        uint index = cluster_lights[range.offset + i];
        GpuLight light = light_data(index);
        vec3 offset = light.position_range.xyz - world;
        float d2 = dot(offset, offset);
        float d = sqrt(d2);
        vec3 to_light = offset / max(d, 1e-6);
        float attenuation = lamp_attenuation(d2, light.intensity_radius.w, 1.0 / light.position_range.w) *
                            spot_cone(-dot(to_light, light.direction_type.xyz), light.cone_shadow.xy);
        if (attenuation <= 0.0) continue;
        vec3 illuminance = light.intensity_radius.rgb * attenuation;
#if SHADOWS
        if (light.cone_shadow.z >= 0.0) {
            count_work(WORK_SHADOW_LOOKUPS, 1u);
            illuminance *= light_shadow_volume(light, world);
        }
#endif
#if MEDIUM_TRANSMITTANCE
        illuminance *= medium_lamp_transmittance(index, world, to_light, d);
#endif
        sum += illuminance;
    }
    return sum;
}
#endif

vec3 air_light(vec3 world, vec2 screen, float view_depth) {
    vec3 light = vec3(0.0);
#if HAS_SUN
    light += ISOTROPIC_PHASE * air_sun(world, view_depth);
#endif
#if HAS_LAMPS
    light += ISOTROPIC_PHASE * air_lamps(world, screen, view_depth);
#endif
#if SKY_VISIBILITY
    light += sky_radiance_at(world).mean;
#else
    if (frame.exposure.y > 0.0) light += ambient_mean_radiance();  // the sky's
#endif
    return light;
}

#endif
