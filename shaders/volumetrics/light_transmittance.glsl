// What the global media leave of light on its way to a point. For surface lighting in a host's shaders: bind the
// block with Volumetrics::bind_uniforms().
#ifndef VOLUMETRICS_LIGHT_TRANSMITTANCE_GLSL
#define VOLUMETRICS_LIGHT_TRANSMITTANCE_GLSL

#include "shaders/volumetrics/global_media.glsl"

// Towards the sun. A homogeneous medium fills all space and has no boundary at which sunlight could enter it: the
// sun's illuminance is what arrives inside of it. Height media end upwards and attenuate by the closed form.
vec3 sun_optical_depth(float y, vec3 to_sun) {
    if (volumetrics.options.y == 0u) return vec3(0.0);
    return height_optical_depth_to_infinity(y, to_sun.y);
}

// Over the path between a point and a lamp.
vec3 lamp_optical_depth(float y, vec3 to_lamp, float path_length) {
    if (volumetrics.options.y == 0u) return vec3(0.0);
    return volumetrics.homogeneous_sigma_t.rgb * path_length + height_optical_depth(y, to_lamp.y, path_length);
}

// `to_light_unit` points from the point to the light, `path_length` metres away; < 0: the sun. 1 where the setting
// light_transmittance is off. Local media do not attenuate it.
vec3 medium_light_transmittance(vec3 point, vec3 to_light_unit, float path_length) {
    if (path_length < 0.0) return exp(-sun_optical_depth(point.y, to_light_unit));
    return exp(-lamp_optical_depth(point.y, to_light_unit, path_length));
}

#endif
