// What media leave of light on its way to a point. For surface lighting in a host's shaders: define LIGHT_VOLUMES as
// Volumetrics::add_light_passes says, and bind with Volumetrics::bind_uniforms().
//
// Global media attenuate in closed form. Local media do as the light volumes hold it (LIGHT_VOLUMES 1):
// sums of optical depth along the light's rays, exact at each texel for media of constant density, in between linear; so
// edges are as soft as a texel. LIGHT_VOLUMES 2: density grids are among them.
#ifndef VOLUMETRICS_LIGHT_TRANSMITTANCE_GLSL
#define VOLUMETRICS_LIGHT_TRANSMITTANCE_GLSL

#include "shaders/lib/work.glsl"
#include "shaders/shared/lights.h"
#include "shaders/volumetrics/media/global_media.glsl"
#include "shaders/volumetrics/light/light_volume.glsl"

#ifndef LIGHT_VOLUMES
#define LIGHT_VOLUMES 0
#endif

// Towards the sun. A homogeneous medium fills all space and has no boundary at which sunlight could enter it: the
// sun's illuminance is what arrives inside of it. Height media end upwards and attenuate by the closed form.
vec3 sun_optical_depth(float y, vec3 to_sun) {
    if (volumetrics.light_transmittance == 0u) return vec3(0.0);
    return height_optical_depth_to_infinity(y, to_sun.y);
}

// Over the path between a point and a lamp, or a further sun.
vec3 lamp_optical_depth(float y, vec3 to_lamp, float path_length) {
    if (volumetrics.light_transmittance == 0u) return vec3(0.0);
    float in_homogeneous = path_length < 0.5 * SUN_LAMP_DISTANCE ? path_length : 0.0;
    return volumetrics.homogeneous_sigma_t.rgb * in_homogeneous + height_optical_depth(y, to_lamp.y, path_length);
}

#if LIGHT_VOLUMES
layout(binding = UNIT_SUN_VOLUME) uniform sampler3D sun_volume;
layout(binding = UNIT_LAMP_VOLUMES) uniform sampler3D lamp_volumes;
struct LampVolume {
    vec4 tile;    // xy its corner in texels, < 0 none; z distance (m) where it begins, w 1 / its length
    vec4 window;  // see light_volume.glsl
};
#if LIGHT_VOLUMES > 1
layout(binding = UNIT_GRID_SUN) uniform sampler3D grid_sun_volume;
#define LAMP_VOLUME_READS WORK_GRID_LIGHT_READS
#else
#define LAMP_VOLUME_READS WORK_TEXTURE_FETCHES
#endif
layout(std430, binding = BINDING_LAMP_VOLUMES) readonly buffer LampVolumeBuffer { LampVolume lamp_volume[]; };  // by light index
#endif

// Of the density grids between the sun and a point: each has a part of one volume, which holds sums of its density along the
// sun's rays, m.
vec3 grid_sun_optical_depth(vec3 point) {
    vec3 depth = vec3(0.0);
#if LIGHT_VOLUMES > 1
    for (uint i = 0u; i < volumetrics.grid_suns; ++i) {
        vec3 place = (volumetrics.grid_sun[i].world_to_volume * vec4(point, 1.0)).xyz;
        place = clamp(place, volumetrics.grid_sun[i].low.xyz, volumetrics.grid_sun[i].high.xyz);
        count_work(WORK_GRID_LIGHT_READS, 1u);
        depth += volumetrics.grid_sun[i].sigma_t.rgb * textureLod(grid_sun_volume, place, 0.0).r;
    }
#endif
    return depth;
}

// Of the local media between the sun and a point. Clamping of the coordinates is right everywhere: beside the box and
// before it the texels hold 0, behind it the last ones the whole sum.
vec3 local_sun_optical_depth(vec3 point) {
#if LIGHT_VOLUMES
    if (volumetrics.light_transmittance == 0u) return vec3(0.0);
    count_work(WORK_TEXTURE_FETCHES, 1u);
    return textureLod(sun_volume, (volumetrics.world_to_sun_volume * vec4(point, 1.0)).xyz, 0.0).rgb +
           grid_sun_optical_depth(point);
#else
    return vec3(0.0);
#endif
}

// Of the local media between a lamp, by its index for light_at(), and a point.
vec3 local_lamp_optical_depth(uint index, vec3 from_lamp, float path_length) {
#if LIGHT_VOLUMES
    if (index >= uint(lamp_volume.length())) return vec3(0.0);
    vec4 tile = lamp_volume[index].tile;
    if (tile.x < 0.0 || path_length <= tile.z) return vec3(0.0);
    vec4 sizes = volumetrics.lamp_volumes;
    vec2 place = lamp_tile_place(from_lamp, lamp_volume[index].window);
    vec2 texel = tile.xy + clamp(place * sizes.x, -0.5, sizes.x + 0.5);
    float share = min((path_length - tile.z) * tile.w, 1.0);
    float w = (share * (sizes.y - 1.0) + 0.5) / sizes.y;
    count_work(LAMP_VOLUME_READS, 1u);
    return textureLod(lamp_volumes, vec3(texel * sizes.zw, w), 0.0).rgb;
#else
    return vec3(0.0);
#endif
}

// To surfaces: `to_light_unit` points from the point to the light. 1 where the setting light_transmittance is off.
vec3 medium_sun_transmittance(vec3 point, vec3 to_sun_unit) {
    return exp(-(sun_optical_depth(point.y, to_sun_unit) + local_sun_optical_depth(point)));
}
vec3 medium_lamp_transmittance(uint index, vec3 point, vec3 to_lamp_unit, float path_length) {
    return exp(-(lamp_optical_depth(point.y, to_lamp_unit, path_length) +
                 local_lamp_optical_depth(index, -to_lamp_unit, path_length)));
}

#endif
