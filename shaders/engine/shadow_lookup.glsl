// Visibility of the sun and of lamps from the engine's shadow maps: 0 dark, 1 lit. World space, metres.
//
// All depth is reversed, greater is nearer to the light: a map holds the casters nearest to the light, and a point is
// lit where its own depth >= the map's (compare samplers with GL_GEQUAL, bound by ShadowSunPass and ShadowAtlasPass).
//
// `normal` is the unit normal of the surface; the geometric one is best. Planes are free of acne because a
// filter that reads up to r texels away sees a depth change of r t tan(a) for texels of size t and an angle a
// between the normal and the map's axis: a shift of h along the normal gains h / cos(a), so h = r t sin(a) is
// enough. Half of it is done by the caster's slope-scaled bias.
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
layout(binding = UNIT_SUN_CASCADES) uniform sampler2DArrayShadow sun_cascade_maps;
layout(binding = UNIT_SUN_STATIC) uniform sampler2DShadow sun_static_map;
layout(binding = UNIT_SHADOW_ATLAS) uniform sampler2DShadow shadow_atlas;
layout(std430, binding = BINDING_SHADOW_TILES) readonly buffer ShadowTileBuffer { ShadowTile shadow_tiles[]; };

// Texels in the air: half a texel towards the light keeps the end of a ray, which lies on a surface, out of it.
const float shadow_volume_bias = 0.5;

// Metres along the normal, for a texel of that size; cos_axis: between normal and the map's axis.
float shadow_normal_offset(float texel, float cos_axis) {
    return texel * (0.1 + 1.4 * sqrt(max(1.0 - cos_axis * cos_axis, 0.0)));
}

// The cascade of a view depth (m), SUN_CASCADES beyond the last.
int sun_cascade_at(float view_depth) {
    vec4 beyond = step(frame.sun_cascade_far, vec4(view_depth));
    return int(dot(beyond, vec4(1.0)));
}

bool in_map(vec3 p) { return all(lessThan(abs(p.xy - 0.5), vec2(0.5))); }

// p: uv and depth. Casters or receivers outside the depth range were clamped to it.
float sun_static_lookup(vec3 p) {
    return texture(sun_static_map, vec3(p.xy, clamp(p.z, 0.0, 1.0)));
}
float sun_cascade_lookup(int cascade, vec3 p) {
    return texture(sun_cascade_maps, vec4(p.xy, float(cascade), clamp(p.z, 0.0, 1.0)));
}

// Half a texel off centre in both axes, four bilinear taps are a 3x3 tent.
const vec2 shadow_taps[4] = vec2[4](vec2(-0.5, -0.5), vec2(0.5, -0.5), vec2(-0.5, 0.5), vec2(0.5, 0.5));

// One map; map SUN_CASCADES is the static one, which also serves what a cascade does not cover.
float sun_map_surface(int map, vec3 world, vec3 normal) {
    float cos_axis = dot(normal, frame.sun_direction.xyz);
    float lit = 0.0;
    if (map < SUN_CASCADES) {
        vec3 p = (frame.sun_cascade[map] *
                  vec4(world + normal * shadow_normal_offset(frame.sun_texel[map], cos_axis), 1.0)).xyz;
        if (in_map(p)) {
            count_work(WORK_SHADOW_LOOKUPS, 4u);
            for (int i = 0; i < 4; ++i)
                lit += sun_cascade_lookup(map, p + vec3(shadow_taps[i] * frame.sun_static_texel.y, 0.0));
            return 0.25 * lit;
        }
    }
    vec3 p = (frame.sun_static *
              vec4(world + normal * shadow_normal_offset(frame.sun_static_texel.x, cos_axis), 1.0)).xyz;
    if (!in_map(p)) return 1.0;
    count_work(WORK_SHADOW_LOOKUPS, 4u);
    for (int i = 0; i < 4; ++i) lit += sun_static_lookup(p + vec3(shadow_taps[i] * frame.sun_static_texel.z, 0.0));
    return 0.25 * lit;
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
    vec3 towards_sun = -shadow_volume_bias * frame.sun_direction.xyz;
    int cascade = sun_cascade_at(view_depth);
    if (cascade < SUN_CASCADES) {
        vec3 p = (frame.sun_cascade[cascade] * vec4(world + towards_sun * frame.sun_texel[cascade], 1.0)).xyz;
        if (in_map(p)) return sun_cascade_lookup(cascade, p);
    }
    vec3 p = (frame.sun_static * vec4(world + towards_sun * frame.sun_static_texel.x, 1.0)).xyz;
    return in_map(p) ? sun_static_lookup(p) : 1.0;
}

// Face of a cube that a direction from its centre passes: +X -X +Y -Y +Z -Z.
int cube_face(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x > 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y > 0.0 ? 2 : 3;
    return d.z > 0.0 ? 4 : 5;
}
bool is_point(GpuLight light) { return light.direction_type.w < 0.5; }
uint shadow_tile_of(GpuLight light, vec3 world) {
    int face = is_point(light) ? cube_face(world - light.position_range.xyz) : 0;
    return uint(int(light.cone_shadow.z) + face);
}

// A clip position's place in its tile, kept where no bilinear tap reads a neighbour, moved by `tap` texels.
float atlas_lookup(ShadowTile tile, vec4 clip, vec2 tap) {
    float half_texel = tile.rect.w;
    vec3 p = clip.xyz / clip.w;
    vec2 uv = tile.rect.xy + tile.rect.z * (0.5 + 0.5 * p.xy) + tap * 2.0 * half_texel;
    uv = clamp(uv, tile.rect.xy + half_texel, tile.rect.xy + tile.rect.z - half_texel);
    return texture(shadow_atlas, vec3(uv, clamp(p.z, 0.0, 1.0)));
}

// Filtered, for surfaces. 1 for a light without a shadow, without a drawn tile, and nearer to the light than its map
// begins.
float light_shadow_surface(GpuLight light, vec3 world, vec3 normal) {
    if (light.cone_shadow.z < 0.0) return 1.0;
    ShadowTile tile = shadow_tiles[shadow_tile_of(light, world)];
    // Clip w is the distance along the tile's axis.
    mat4 m = tile.world_to_clip;
    vec4 w_row = vec4(m[0].w, m[1].w, m[2].w, m[3].w);
    float distance_on_axis = max(dot(w_row, vec4(world, 1.0)), 0.0);
    float offset = shadow_normal_offset(tile.depth.z * distance_on_axis, dot(normal, w_row.xyz));
    vec3 p = world + normal * offset;
    tile = shadow_tiles[shadow_tile_of(light, p)];
    vec4 clip = tile.world_to_clip * vec4(p, 1.0);
    if (tile.depth.w == 0.0 || clip.w <= tile.depth.x) return 1.0;
    float lit = 0.0;
    count_work(WORK_SHADOW_LOOKUPS, 4u);
    for (int i = 0; i < 4; ++i) lit += atlas_lookup(tile, clip, shadow_taps[i]);
    return 0.25 * lit;
}

// One lookup, for points in the air. The same limits.
float light_shadow_volume(GpuLight light, vec3 world) {
    if (light.cone_shadow.z < 0.0) return 1.0;
    ShadowTile tile = shadow_tiles[shadow_tile_of(light, world)];
    vec3 p = world + shadow_volume_bias * tile.depth.z * (light.position_range.xyz - world);
    vec4 clip = tile.world_to_clip * vec4(p, 1.0);
    if (tile.depth.w == 0.0 || clip.w <= tile.depth.x) return 1.0;
    return atlas_lookup(tile, clip, vec2(0.0));
}

#else

float sun_shadow_surface(vec3 world, vec3 normal, float view_depth) { return 1.0; }
float sun_shadow_volume(vec3 world, float view_depth) { return 1.0; }
float light_shadow_surface(GpuLight light, vec3 world, vec3 normal) { return 1.0; }
float light_shadow_volume(GpuLight light, vec3 world) { return 1.0; }

#endif
#endif
