#ifndef SHARED_SKY_VOLUME_H
#define SHARED_SKY_VOLUME_H
#include "shaders/shared/types.h"

SHARED_BEGIN

// A direction of the sky, and the light of the part of the sky that it stands for: its share of the mean over the sphere, and three
// times the share of the mean of radiance times direction.
struct SkyDirection {
    mat4 world_to_map;  // to texture xyz of its map, reversed: nearer to the sky is greater
    vec4 red;           // x mean, yzw slope
    vec4 green;
    vec4 blue;
};

SHARED_END
#endif
