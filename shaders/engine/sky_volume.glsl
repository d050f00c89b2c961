// Light of the sky as it arrives at a point, past all that stands still: engine/render/passes/sky_volume.h.
#ifndef ENGINE_SKY_VOLUME_GLSL
#define ENGINE_SKY_VOLUME_GLSL

#include "shaders/engine/frame_block.glsl"
#include "shaders/lib/sky_radiance.glsl"

#if SKY_VISIBILITY
// Slabs of layers, one above the other: of each level, the coarsest last, red, green and blue; then the open sky, a layer each.
// rgba: mean, slope.
layout(binding = UNIT_AMBIENT) uniform sampler3D sky_volume;

SkyRadiance sky_of(vec4 red, vec4 green, vec4 blue) {
    float factor = frame.exposure.y;
    return SkyRadiance(factor * vec3(red.x, green.x, blue.x), factor * red.yzw, factor * green.yzw, factor * blue.yzw);
}

SkyRadiance sky_radiance_open() {
    int first = 3 * int(frame.sky_cells.z * frame.sky_cells.w);
    return sky_of(texelFetch(sky_volume, ivec3(0, 0, first), 0), texelFetch(sky_volume, ivec3(0, 0, first + 1), 0),
                  texelFetch(sky_volume, ivec3(0, 0, first + 2), 0));
}

vec3 sky_cell(vec3 world, int level) { return (world - frame.sky_level[level].xyz) * frame.sky_level[level].w; }

// The finest level whose cells surround the point; outside all of them the coarsest, whose border goes on.
int sky_level_at(vec3 world) {
    vec3 last = frame.sky_cells.xyz - 1.0;
    int level = int(frame.sky_cells.w) - 1;
    for (int i = SKY_LEVELS - 2; i >= 0; --i) {
        vec3 cell = sky_cell(world, i);
        if (i < level && cell == clamp(cell, vec3(0.0), last)) level = i;
    }
    return level;
}

SkyRadiance sky_radiance_in(vec3 world, int level) {
    vec3 cells = frame.sky_cells.xyz;
    vec3 place = clamp(sky_cell(world, level), vec3(0.0), cells - 1.0) + 0.5;
    place.z += float(3 * level) * cells.z;
    vec3 scale = 1.0 / vec3(textureSize(sky_volume, 0));
    vec3 slab = vec3(0.0, 0.0, cells.z);
    return sky_of(textureLod(sky_volume, place * scale, 0.0), textureLod(sky_volume, (place + slab) * scale, 0.0),
                  textureLod(sky_volume, (place + 2.0 * slab) * scale, 0.0));
}

SkyRadiance sky_radiance_at(vec3 world) { return sky_radiance_in(world, sky_level_at(world)); }

// On a surface: so far before it that what lies behind is not asked, nor cells which a thin wall darkens.
SkyRadiance sky_radiance_on(vec3 world, vec3 normal) {
    const float CELLS_BEFORE = 1.5;
    int level = sky_level_at(world);
    float before = CELLS_BEFORE * (abs(normal.x) + abs(normal.y) + abs(normal.z)) / frame.sky_level[level].w;
    return sky_radiance_in(world + before * normal, level);
}
#endif

#endif
