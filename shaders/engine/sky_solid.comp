// Marks the cells whose centre lies in a body: both ways along an axis lead out of it; or one way does, and no light comes in. So a
// place before the back of an open sheet, which has light, is none.
#include "shaders/engine/sky_links.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(rgba16f, binding = 0) readonly uniform image3D sums;
layout(r32ui, binding = 1) uniform uimage3D links;

uniform ivec3 cells;
uniform float darkest;  // mean radiance of all channels that counts as none

void main() {
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, cells))) return;
    float light = 0.0;
    for (int c = 0; c < 3; ++c) light += imageLoad(sums, cell + ivec3(0, 0, c * cells.z)).x;
    bool inside = false;
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 below = cell;
        --below[axis];
        bool out_above = sky_outward(imageLoad(links, cell).r, axis) > 0;
        bool out_below = below[axis] >= 0 && sky_outward(imageLoad(links, below).r, axis) < 0;
        inside = inside || (light > darkest ? out_above && out_below : out_above || out_below);
    }
    if (inside) imageAtomicOr(links, cell, SKY_LINK_SOLID);
}
