// Particles of the engine, sorted back to front.
#ifndef SHARED_PARTICLES_H
#define SHARED_PARTICLES_H
#include "shaders/shared/types.h"

SHARED_BEGIN

struct Particle {
    vec4 position_radius;  // xyz world (m), w radius (m)
    vec4 color_opacity;    // rgb share of light that it scatters 0..1, a opacity in its middle 0..1
    vec4 emission_seed;    // rgb radiance, w random 0..1: its turn and its outline
};

SHARED_END
#endif
