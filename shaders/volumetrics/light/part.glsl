// Light whose visible share is stored apart from it (relight.frag).
#ifndef VOLUMETRICS_PART_GLSL
#define VOLUMETRICS_PART_GLSL

#include "shaders/lib/pack.glsl"

struct Part {
    vec3 visible;
    vec3 whole;  // unshadowed
};

// Visible share of each channel, that of the mean in a channel without light; and its weight, 0 where there is no light.
vec4 visible_share(Part light) {
    const float LEAST = 1.0e-7;
    vec3 whole = min(light.whole, 1.0e30);
    vec3 visible = min(light.visible, whole);
    float mean = dot(whole, vec3(1.0 / 3.0));
    if (!(mean > LEAST)) return vec4(0.0);
    vec3 mean_share = vec3(dot(visible, vec3(1.0 / 3.0)) / mean);
    vec3 share = mix(visible / max(whole, LEAST), mean_share, lessThan(whole, vec3(LEAST)));
    return round_to_half(vec4(clamp(share, 0.0, 1.0), 1.0));
}

#endif
