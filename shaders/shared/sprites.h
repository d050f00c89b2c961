// What the techniques billboards and particles draw.
#ifndef SHARED_SPRITES_H
#define SHARED_SPRITES_H
#include "shaders/shared/types.h"

// Billboard.slab.z where it is no index of a local medium.
#define BILLBOARD_GLOBAL -1
#define BILLBOARD_HORIZON -2  // all global media behind slab.x

SHARED_BEGIN

struct Billboard {
    vec4 rect;  // on the screen, NDC: x, y lower left, z, w upper right
    vec4 slab;  // x nearest, y farthest view depth (m) of the space it stands for; z index of the local medium, or BILLBOARD_*
};

struct ParticleSprite {
    vec4 center_radius;  // xyz from the eye, along the axes of the world, w radius (m); 0: not drawn
    vec4 light;          // rgb what it sends to the eye, radiance m^2; a mean of `certain`
    vec4 certain;        // rgb what the sum of it over a pixel's particles is known for, see particles_resolve.frag; a 1: of a
                         // local medium, 0: of the global ones
};

SHARED_END

#endif
