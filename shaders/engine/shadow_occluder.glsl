// What light meets first, from the engine's shadow maps: see shaders/interface/shadow_maps.glsl. Each point has the plane of
// the four texels around where they lie in one, as in shadow_lookup.glsl, else the texel that it lies in.
#ifndef ENGINE_SHADOW_OCCLUDER_GLSL
#define ENGINE_SHADOW_OCCLUDER_GLSL

#include "shaders/engine/shadow_lookup.glsl"

const float NO_OCCLUDER = 1.0e9;

#if SHADOWS
float occluder_depth(MapTexels texels, MapPoint p) {
    float plane;
    if (texels_plane(texels, p.texel, vec2(0.0), plane)) return plane;
    bvec2 far_side = greaterThan(texels.weight, vec2(0.5));
    vec2 row = far_side.y ? texels.depth.xy : texels.depth.wz;
    return far_side.x ? row.y : row.x;
}

// Of the finest map that holds the point. A map's depth ends near its part of the view, and casters beyond are clamped to
// it: where it says no more than that, the next one is asked.
float sun_shadow_occluder(vec3 world) {
    for (int map = 0; map <= SUN_CASCADES; ++map) {
        vec3 p = (sun_map_matrix(map) * vec4(world, 1.0)).xyz;
        if (!in_map(p)) continue;
        MapPoint point = sun_map_point(map, p, 1.0, 0.0);
        float depth = occluder_depth(sun_texels(map, point.place), point);
        if (map < SUN_CASCADES && (depth <= 0.0 || depth >= 1.0)) continue;
        return depth <= 0.0 ? -NO_OCCLUDER : (depth - p.z) / sun_map_scale(sun_map_matrix(map));
    }
    return -NO_OCCLUDER;
}

// A lamp's depth is a + b / w at the distance w along the tile's axis; a sun's is linear.
float light_shadow_occluder(GpuLight light, vec3 world) {
    if (light.cone_shadow.z < 0.0) return -NO_OCCLUDER;
    ShadowTile tile = shadow_tile(light, world);
    vec4 clip = tile.world_to_clip * vec4(world, 1.0);
    if (tile.depth.w == 0.0 || clip.w <= 0.0 || beside_sun_tile(light, clip)) return -NO_OCCLUDER;
    MapPoint point = tile_point(light, tile, clip, tile.depth.z * clip.w, 1.0, 0.0);
    float depth = occluder_depth(tile_texels(tile, point.place), point);
    if (depth <= 0.0) return -NO_OCCLUDER;
    if (int(light.direction_type.w) == LIGHT_SUN)
        return (depth - clip.z / clip.w) * tile.depth.z * clip.w / point.texel;
    vec3 from_lamp = world - light.position_range.xyz;
    float b = (tile.world_to_clip * vec4(light.position_range.xyz, 1.0)).z;
    float a = (clip.z - b) / clip.w;
    return length(from_lamp) * (1.0 - b / (max(depth - a, 1.0e-12) * clip.w));
}
#else
float sun_shadow_occluder(vec3 world) { return -NO_OCCLUDER; }
float light_shadow_occluder(GpuLight light, vec3 world) { return -NO_OCCLUDER; }
#endif

#endif
