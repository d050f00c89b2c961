// What glass leaves of light on its way to a point, from maps beside the shadow maps: rgb the product of the filters of all
// glass before the first opaque surface, a where the glass nearest to the light is, 0 where there is none. What lies behind
// that is filtered: between two panes as if behind both.
#ifndef ENGINE_GLASS_LOOKUP_GLSL
#define ENGINE_GLASS_LOOKUP_GLSL

#include "shaders/engine/shadow_lookup.glsl"

#ifndef GLASS
#define GLASS 0
#endif

#if GLASS
layout(binding = UNIT_SUN_GLASS) uniform sampler2DArray sun_glass_maps;  // the cascades, and the baked map
layout(binding = UNIT_LAMP_GLASS) uniform sampler2DArray lamp_glass_map;

// The mean over the texels around that hold glass: those at its rim do not mix with what holds it. `place` is in texels,
// those from `low` to `high` are read; nearness: of the point, as a.
vec3 glass_texels(sampler2DArray maps, int layer, vec2 place, ivec2 low, ivec2 high, float nearness) {
    vec2 corner = floor(place - 0.5);
    vec4 any_glass = textureGather(maps, vec3((corner + 1.0) / vec2(textureSize(maps, 0).xy), float(layer)), 3);
    if (all(equal(any_glass, vec4(0.0)))) return vec3(1.0);  // nearly everywhere
    vec2 further = place - 0.5 - corner;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        vec4 glass = texelFetch(maps, ivec3(clamp(ivec2(corner) + side, low, high), layer), 0);
        vec2 weight = mix(1.0 - further, further, vec2(side));
        if (glass.a > 0.0) sum += weight.x * weight.y * vec4(nearness < glass.a ? glass.rgb : vec3(1.0), 1.0);
    }
    return sum.a > 0.0 ? sum.rgb / sum.a : vec3(1.0);
}

vec3 sun_glass(vec3 world, float view_depth) {
    float size = frame.sun_static_texel.w;
    if (size == 0.0) return vec3(1.0);
    int map = sun_cascade_at(view_depth);
    vec3 p = (sun_map_matrix(map) * vec4(world, 1.0)).xyz;
    if (map < SUN_CASCADES && !in_map(p)) {
        map = SUN_CASCADES;
        p = (frame.sun_static * vec4(world, 1.0)).xyz;
    }
    if (!in_map(p)) return vec3(1.0);
    return glass_texels(sun_glass_maps, map, p.xy * size, ivec2(0), ivec2(size) - 1, clamp(p.z, 0.0, 1.0));
}

// In the finest map that holds the ray: all of them hold all glass before it.
bool sun_ray_glass(vec3 world) {
    float size = frame.sun_static_texel.w;
    vec3 p = vec3(-1.0);
    int map = -1;
    while (map < SUN_CASCADES && !in_map(p)) p = (sun_map_matrix(++map) * vec4(world, 1.0)).xyz;
    vec4 glass = textureGather(sun_glass_maps, vec3((floor(p.xy * size - 0.5) + 1.0) / size, float(map)), 3);
    return size > 0.0 && in_map(p) && any(greaterThan(glass, vec4(0.0)));
}

// A lamp's a is 1 - w / far at the distance w along the tile's axis; a further sun's is its map's depth.
vec3 light_glass(GpuLight light, vec3 world) {
    if (light.cone_shadow.w == 0.0 || light.cone_shadow.z < 0.0) return vec3(1.0);
    ShadowTile tile = shadow_tile(light, world);
    vec4 clip = tile.world_to_clip * vec4(world, 1.0);
    if (tile.depth.w == 0.0 || clip.w <= tile.depth.x || beside_sun_tile(light, clip)) return vec3(1.0);
    bool sun = int(light.direction_type.w) == LIGHT_SUN;
    float nearness = sun ? clamp(clip.z / clip.w, 0.0, 1.0) : 1.0 - clip.w / tile.depth.y;
    float size = float(textureSize(lamp_glass_map, 0).x);
    vec2 place = (tile.rect.xy + tile.rect.z * (0.5 + 0.5 * clip.xy / clip.w)) * size;
    ivec2 low = ivec2(tile.rect.xy * size + 0.5);
    return glass_texels(lamp_glass_map, 0, place, low, low + int(tile.rect.z * size + 0.5) - 1, nearness);
}
#endif

#endif
