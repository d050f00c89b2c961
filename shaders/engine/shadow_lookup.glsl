// Visibility of the sun and of lamps from the engine's shadow maps: 0 dark, 1 lit. World space, metres.
//
// All depth is reversed, greater is nearer to the light: a map holds the casters nearest to the light, and a point is
// lit where its own depth >= the map's.
//
// Four neighbouring texels that lie in a plane are compared as that plane, at the point itself: so a plane neither shadows
// itself nor lets light through, however steep it is, however thin the wall and however near behind it the point. Texels
// at an edge are compared one by one. There a surface would shadow itself, for it changes its depth from texel to texel:
// so the point is moved along its normal (the geometric one is best). A filter that reads up to r texels away sees a
// depth change of r t tan(a) for texels of size t and an angle a between the normal and the map's axis, more on the
// diagonal: a shift of h along the normal gains h / cos(a), so h = 1.5 r t sin(a) is enough; a quarter of it is done by
// the bias of the casters' fronts. Where two lit planes meet, texels of both are taken for one plane before them: hence
// the constant part.
//
// Texels through which light passes behind the surface, because it ends there, say nothing about it: they do not count,
// so that what is outside of a room does not light the foot of its walls. Of the air that is true where beside a caster
// the map is empty.
//
// SHADOWS 0: everything is lit, no sampler is declared.
#ifndef ENGINE_SHADOW_LOOKUP_GLSL
#define ENGINE_SHADOW_LOOKUP_GLSL

#include "shaders/engine/light_data.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/shared/shadows.h"

#ifndef SHADOWS
#define SHADOWS 1
#endif

#if SHADOWS
layout(binding = UNIT_SUN_CASCADES) uniform sampler2DArray sun_cascade_maps;
layout(binding = UNIT_SUN_STATIC) uniform sampler2D sun_static_map;
layout(binding = UNIT_SHADOW_ATLAS) uniform sampler2D shadow_atlas;
layout(rgba32f, binding = IMAGE_SHADOW_TILES) readonly uniform imageBuffer shadow_tile_texels;

// A plane changes its depth by at most so many texels from one to the next: what changes more is an edge.
const float SHADOW_STEEPEST = 8.0;

// Metres along the normal, for a texel of that size; cos_axis: between normal and the map's axis.
float shadow_normal_offset(float texel, float cos_axis) {
    return texel * (0.6 + 1.6 * sqrt(max(1.0 - cos_axis * cos_axis, 0.0)));
}

// A point in a map: place in texels, depth, and what in depth are a texel and how far behind the point its own surface may
// lie in the texels of the filter.
struct MapPoint {
    vec2 place;
    float depth;
    float texel;
    float behind;
};

// Texels whose corners meet at floor(place) + 0.5, in textureGather's order.
struct MapTexels {
    vec4 depth;
    vec2 weight;  // of those to the right and above
};

float weighted_mean(vec4 v, vec2 weight) { return mix(mix(v.w, v.z, weight.x), mix(v.x, v.y, weight.x), weight.y); }

// Whether the texels lie in a plane, of which a texel is `texel` in depth, and its depth `ahead` texels from the middle of
// their weights.
bool texels_plane(MapTexels texels, float texel, vec2 ahead, out float depth) {
    vec4 d = texels.depth;
    float nearest = max(max(d.x, d.y), max(d.z, d.w));
    float steps = nearest - min(min(d.x, d.y), min(d.z, d.w));
    float twist = abs(d.x + d.z - d.y - d.w);
    vec2 slope = vec2(mix(d.z - d.w, d.y - d.x, texels.weight.y), mix(d.x - d.w, d.y - d.z, texels.weight.x));
    depth = min(weighted_mean(d, texels.weight) + dot(slope, ahead), nearest);  // it may end there
    return steps <= SHADOW_STEEPEST * texel && twist <= 0.1 * steps + 0.05 * texel;
}

// x: share of the texels that let light through at the point, y: of those through which it passes behind it. `ahead`: from
// the middle of the texels' weights to the point, texels.
vec2 texels_lit(MapTexels texels, MapPoint p, vec2 ahead) {
    float plane;
    vec4 d = texels.depth;
    if (texels_plane(texels, p.texel, ahead, plane)) d = vec4(plane);
    return vec2(weighted_mean(step(d, vec4(p.depth)), texels.weight),
                weighted_mean(step(d, vec4(p.depth - p.behind)), texels.weight));
}

// Half a texel off centre in both axes, four bilinear taps are a 3x3 tent.
const vec2 shadow_taps[4] = vec2[4](vec2(-0.5, -0.5), vec2(0.5, -0.5), vec2(-0.5, 0.5), vec2(0.5, 0.5));

// Of the mean of what texels_lit gives. Where nothing of the surface is in the map it is lit.
float visible_share(vec2 mean) { return mean.y < 0.999 ? clamp((mean.x - mean.y) / (1.0 - mean.y), 0.0, 1.0) : 1.0; }

// Depth per metre towards the light in a sun's map.
float sun_map_scale(mat4 world_to_texture) {
    return length(vec3(world_to_texture[0].z, world_to_texture[1].z, world_to_texture[2].z));
}

// The cascade of a view depth (m), SUN_CASCADES beyond the last.
int sun_cascade_at(float view_depth) {
    vec4 beyond = step(frame.sun_cascade_far, vec4(view_depth));
    return int(dot(beyond, vec4(1.0)));
}

bool in_map(vec3 p) { return all(lessThan(abs(p.xy - 0.5), vec2(0.5))); }

mat4 sun_map_matrix(int map) { return map < SUN_CASCADES ? frame.sun_cascade[map] : frame.sun_static; }
float sun_map_texel(int map) { return map < SUN_CASCADES ? frame.sun_texel[map] : frame.sun_static_texel.x; }
float sun_map_texel_uv(int map) { return map < SUN_CASCADES ? frame.sun_static_texel.y : frame.sun_static_texel.z; }

MapTexels sun_texels(int map, vec2 place) {
    vec2 corner = floor(place - 0.5);
    vec2 uv = (corner + 1.0) * sun_map_texel_uv(map);
    return MapTexels(map < SUN_CASCADES ? textureGather(sun_cascade_maps, vec3(uv, float(map)))
                                        : textureGather(sun_static_map, uv),
                     place - 0.5 - corner);
}

// Casters outside the depth range were clamped to it: so are receivers. z: as in_map's.
MapPoint sun_map_point(int map, vec3 p, float cos_axis, float offset) {
    float scale = sun_map_scale(sun_map_matrix(map));
    float texel = sun_map_texel(map);
    float behind = 2.0 * offset / max(abs(cos_axis), 0.1) + 4.0 * texel;
    return MapPoint(p.xy / sun_map_texel_uv(map), clamp(p.z, 0.0, 1.0), texel * scale, behind * scale);
}

float sun_point_filtered(int map, MapPoint p) {
    vec2 sum = vec2(0.0);
    count_work(WORK_SHADOW_LOOKUPS, 4u);
    for (int i = 0; i < 4; ++i) sum += texels_lit(sun_texels(map, p.place + shadow_taps[i]), p, -shadow_taps[i]);
    return visible_share(0.25 * sum);
}

// One map; map SUN_CASCADES is the static one, which also serves what a cascade does not cover.
float sun_map_surface(int map, vec3 world, vec3 normal) {
    float cos_axis = dot(normal, frame.sun_direction.xyz);
    float offset = shadow_normal_offset(sun_map_texel(map), cos_axis);
    vec3 p = (sun_map_matrix(map) * vec4(world + normal * offset, 1.0)).xyz;
    if (map < SUN_CASCADES && !in_map(p)) {
        map = SUN_CASCADES;
        offset = shadow_normal_offset(sun_map_texel(map), cos_axis);
        p = (frame.sun_static * vec4(world + normal * offset, 1.0)).xyz;
    }
    if (!in_map(p)) return 1.0;
    return sun_point_filtered(map, sun_map_point(map, p, cos_axis, offset));
}

// Filtered, for surfaces. `view_depth` (m along the view axis) picks the cascade; the last tenth of each is mixed with
// the next one. 1 outside all maps.
float sun_shadow_surface(vec3 world, vec3 normal, float view_depth) {
    int cascade = sun_cascade_at(view_depth);
    float lit = sun_map_surface(cascade, world, normal);
    if (cascade < SUN_CASCADES) {
        float far = frame.sun_cascade_far[cascade];
        float next = 1.0 - (far - view_depth) / (far * SUN_CASCADE_BLEND);
        if (next > 0.0) lit = mix(lit, sun_map_surface(cascade + 1, world, normal), next);
    }
    return lit;
}

// One lookup, for points in the air. Not counted as work here: the volumetrics module counts what it asks for.
float sun_shadow_volume(vec3 world, float view_depth) {
    int map = sun_cascade_at(view_depth);
    vec3 p = (sun_map_matrix(map) * vec4(world, 1.0)).xyz;
    if (map < SUN_CASCADES && !in_map(p)) {
        map = SUN_CASCADES;
        p = (frame.sun_static * vec4(world, 1.0)).xyz;
    }
    if (!in_map(p)) return 1.0;
    MapPoint point = sun_map_point(map, p, 1.0, 0.0);
    point.behind = point.depth;
    return visible_share(texels_lit(sun_texels(map, point.place), point, vec2(0.0)));
}

// Face of a cube that a direction from its centre passes: +X -X +Y -Y +Z -Z.
int cube_face(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x > 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y > 0.0 ? 2 : 3;
    return d.z > 0.0 ? 4 : 5;
}
bool is_point(GpuLight light) { return int(light.direction_type.w) == LIGHT_POINT; }
// Whether a clip position lies beside the map of a further sun.
bool beside_sun_tile(GpuLight light, vec4 clip) {
    return int(light.direction_type.w) == LIGHT_SUN && any(greaterThan(abs(clip.xy), clip.ww));
}
// Where the map looks that holds a point.
vec3 tile_axis(GpuLight light, vec3 world) {
    if (!is_point(light)) return light.direction_type.xyz;
    int face = cube_face(world - light.position_range.xyz);
    vec3 axis = vec3(equal(ivec3(face >> 1), ivec3(0, 1, 2)));
    return (face & 1) == 0 ? axis : -axis;
}
// World size (m) of a texel at 1 m, alike in all tiles of a light.
float shadow_texel(GpuLight light) { return imageLoad(shadow_tile_texels, 6 * int(light.cone_shadow.z) + 5).z; }

// The tile of a light that has a shadow which holds a point.
ShadowTile shadow_tile(GpuLight light, vec3 world) {
    int face = is_point(light) ? cube_face(world - light.position_range.xyz) : 0;
    int i = 6 * (int(light.cone_shadow.z) + face);
    return ShadowTile(mat4(imageLoad(shadow_tile_texels, i), imageLoad(shadow_tile_texels, i + 1),
                           imageLoad(shadow_tile_texels, i + 2), imageLoad(shadow_tile_texels, i + 3)),
                      imageLoad(shadow_tile_texels, i + 4), imageLoad(shadow_tile_texels, i + 5));
}

// A clip position in its tile. `texel`: m. A plane is one in the perspective of a map, too.
MapPoint tile_point(GpuLight light, ShadowTile tile, vec4 clip, float texel, float cos_axis, float offset) {
    mat4 m = tile.world_to_clip;
    vec3 axis = is_point(light) ? vec3(m[0].w, m[1].w, m[2].w) : light.direction_type.xyz;
    float depth = clip.z / clip.w;
    // Depth per metre along the axis.
    float scale = abs(dot(vec3(m[0].z, m[1].z, m[2].z), axis) - depth * dot(vec3(m[0].w, m[1].w, m[2].w), axis)) / clip.w;
    float behind = 2.0 * offset / max(abs(cos_axis), 0.1) + 4.0 * texel;
    vec2 uv = tile.rect.xy + tile.rect.z * (0.5 + 0.5 * clip.xy / clip.w);
    return MapPoint(uv / (2.0 * tile.rect.w), clamp(depth, 0.0, 1.0), texel * scale, behind * scale);
}

// The texels round a place, which is moved to where none of a neighbouring tile are read.
MapTexels tile_texels(ShadowTile tile, inout vec2 place) {
    float texel_uv = 2.0 * tile.rect.w;
    vec2 low = tile.rect.xy / texel_uv + 0.5;
    place = clamp(place, low, low + tile.rect.z / texel_uv - 1.0);
    vec2 corner = min(floor(place - 0.5), low + tile.rect.z / texel_uv - 2.5);
    return MapTexels(textureGather(shadow_atlas, (corner + 1.0) * texel_uv), place - 0.5 - corner);
}

vec2 tile_lit(ShadowTile tile, MapPoint p, vec2 tap) {
    vec2 place = p.place + tap;
    MapTexels texels = tile_texels(tile, place);
    return texels_lit(texels, p, p.place - place);
}

// Filtered, for surfaces. 1 for a light without a shadow, without a drawn tile, nearer to the light than its map begins,
// and beside a sun's map.
float light_shadow_surface(GpuLight light, vec3 world, vec3 normal) {
    if (light.cone_shadow.z < 0.0) return 1.0;
    vec3 axis = tile_axis(light, world);
    bool is_sun = int(light.direction_type.w) == LIGHT_SUN;
    float along = is_sun ? SUN_LAMP_DISTANCE : max(dot(world - light.position_range.xyz, axis), 0.0);
    float texel = shadow_texel(light) * along;
    float cos_axis = dot(normal, axis);
    float offset = shadow_normal_offset(texel, cos_axis);
    vec3 p = world + normal * offset;
    ShadowTile tile = shadow_tile(light, p);
    vec4 clip = tile.world_to_clip * vec4(p, 1.0);
    if (tile.depth.w == 0.0 || clip.w <= tile.depth.x || beside_sun_tile(light, clip)) return 1.0;
    MapPoint point = tile_point(light, tile, clip, texel, cos_axis, offset);
    vec2 sum = vec2(0.0);
    count_work(WORK_SHADOW_LOOKUPS, 4u);
    for (int i = 0; i < 4; ++i) sum += tile_lit(tile, point, shadow_taps[i]);
    return visible_share(0.25 * sum);
}

// One lookup, for points in the air. The same limits.
float light_shadow_volume(GpuLight light, vec3 world) {
    if (light.cone_shadow.z < 0.0) return 1.0;
    ShadowTile tile = shadow_tile(light, world);
    vec4 clip = tile.world_to_clip * vec4(world, 1.0);
    if (tile.depth.w == 0.0 || clip.w <= tile.depth.x || beside_sun_tile(light, clip)) return 1.0;
    MapPoint point = tile_point(light, tile, clip, tile.depth.z * clip.w, 1.0, 0.0);
    point.behind = point.depth;
    return visible_share(tile_lit(tile, point, vec2(0.0)));
}

#else

float sun_shadow_surface(vec3 world, vec3 normal, float view_depth) { return 1.0; }
float sun_shadow_volume(vec3 world, float view_depth) { return 1.0; }
float light_shadow_surface(GpuLight light, vec3 world, vec3 normal) { return 1.0; }
float light_shadow_volume(GpuLight light, vec3 world) { return 1.0; }

#endif
#endif
