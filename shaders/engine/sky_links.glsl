// Surfaces that cross the line between the centres of two neighbouring cells, counted in the lower cell: ten bits for each axis, the
// lower five count those that face along the axis, the upper five those that face against it.
#ifndef ENGINE_SKY_LINKS_GLSL
#define ENGINE_SKY_LINKS_GLSL

const uint SKY_LINK_SOLID = 1u << 30;  // the centre of the cell lies in a body

bool sky_crossed(uint links, int axis) { return (links >> uint(10 * axis) & 1023u) != 0u; }

// > 0: the way along the axis leads out of a body, < 0: into one; 0: through one, or there is none.
int sky_outward(uint links, int axis) {
    uint counts = links >> uint(10 * axis);
    return int(counts & 31u) - int(counts >> 5u & 31u);
}

#endif
