// How alike two pixels are by depth, for filters and up-sampling. Buffer depth is near / view depth: the quotient of two
// needs no conversion, it is linear over a plane on screen, and 0 is the sky, like itself and nothing else.
#ifndef VOLUMETRICS_DEPTH_WEIGHT_GLSL
#define VOLUMETRICS_DEPTH_WEIGHT_GLSL

// |z0 - z1| / max(z0, z1) of the view depths z, 0..1; the sky is more than 1 from all else, least from what is farthest.
float depth_difference(float d0, float d1) {
    float low = min(d0, d1);
    float high = max(d0, d1);
    if (low <= 0.0) return high <= 0.0 ? 0.0 : 1.0 + high;
    return 1.0 - low / high;
}

// Falls linearly with that difference, 1 - falloff |z0 - z1| / max(z0, z1), down to 0. Relative, because the depth step
// between the neighbours of one surface grows with its distance.
float depth_weight(float d0, float d1, float falloff) {
    float difference = depth_difference(d0, d1);
    return difference > 1.0 ? 0.0 : max(1.0 - falloff * difference, 0.0);
}

// Slope per pixel of the plane that a pixel lies in, from its buffer depth and its neighbours' on either side: the smaller
// difference, for the other may cross an edge. Where they have opposite signs one does, or both: then a small one only.
float depth_slope(float before, float here, float after) {
    vec2 slopes = vec2(here - before, after - here);
    float slope = abs(slopes.x) < abs(slopes.y) ? slopes.x : slopes.y;
    return slopes.x * slopes.y > 0.0 || abs(slope) < 0.125 * here ? slope : 0.0;
}

#endif
