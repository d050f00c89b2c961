// From the sums to what is looked up between cells, where cells on both sides of a wall are mixed. So that no light gets through it,
// of two neighbours with a wall between them both take the light of the darker one. In bodies there is none to be
// had: a cell there takes that of its darkest neighbour outside.
#include "shaders/engine/sky_links.glsl"
#include "shaders/lib/pack.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(rgba16f, binding = 0) readonly uniform image3D sums;
layout(r32ui, binding = 1) readonly uniform uimage3D links;
layout(rgba16f, binding = 2) writeonly uniform image3D sky_volume;

uniform ivec3 cells;
uniform int first_layer;  // of the level in sky_volume
uniform int open_layer;   // of the open sky
uniform float scale;      // of the sums, while some directions are missing
uniform vec4 open_red, open_green, open_blue;

float light_of(ivec3 cell) {
    float light = 0.0;
    for (int c = 0; c < 3; ++c) light += imageLoad(sums, cell + ivec3(0, 0, c * cells.z)).x;
    return light;
}

bool is_solid(ivec3 cell) { return (imageLoad(links, cell).r & SKY_LINK_SOLID) != 0u; }

void main() {
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, cells))) return;
    bool solid = is_solid(cell);
    ivec3 from = cell;
    float least = solid ? 1.0e30 : light_of(cell);
    for (int side = 0; side < 6; ++side) {
        int axis = side >> 1;
        ivec3 neighbour = cell;
        neighbour[axis] += (side & 1) == 0 ? 1 : -1;
        if (any(lessThan(neighbour, ivec3(0))) || any(greaterThanEqual(neighbour, cells))) continue;
        uint between = imageLoad(links, min(cell, neighbour)).r;
        if (!sky_crossed(between, axis)) continue;
        bool wall = sky_outward(between, axis) == 0;  // thinner than a cell; else the side of a body
        if (wall == solid || (solid && is_solid(neighbour))) continue;
        float light = light_of(neighbour);
        if (light < least) {
            least = light;
            from = neighbour;
        }
    }
    for (int c = 0; c < 3; ++c)
        imageStore(sky_volume, cell + ivec3(0, 0, first_layer + c * cells.z),
                   round_to_half(scale * imageLoad(sums, from + ivec3(0, 0, c * cells.z))));
    if (cell == ivec3(0)) {
        imageStore(sky_volume, ivec3(0, 0, open_layer), round_to_half(open_red));
        imageStore(sky_volume, ivec3(0, 0, open_layer + 1), round_to_half(open_green));
        imageStore(sky_volume, ivec3(0, 0, open_layer + 2), round_to_half(open_blue));
    }
}
