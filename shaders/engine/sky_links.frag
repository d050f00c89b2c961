// Counts the surfaces between neighbouring cells.
#include "shaders/engine/sky_links.glsl"

layout(r32ui, binding = 0) coherent uniform uimage3D links;
uniform ivec3 cells;
uniform int axis;
uniform bool both_sides;

in vec3 cell;

void main() {
    ivec3 at;
    at[(axis + 1) % 3] = int(gl_FragCoord.x);
    at[(axis + 2) % 3] = int(gl_FragCoord.y);
    at[axis] = int(floor(cell[axis]));
    if (at[axis] < 0 || at[axis] >= cells[axis]) return;
    uint facing = both_sides ? 33u : gl_FrontFacing ? 1u : 32u;
    imageAtomicAdd(links, at, facing << uint(10 * axis));
}
