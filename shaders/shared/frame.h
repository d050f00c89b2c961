// The engine's per-frame uniform block. Shaders and textures hold light in units of Scene::light_unit() cd/m².
#ifndef SHARED_FRAME_H
#define SHARED_FRAME_H
#include "shaders/shared/types.h"

#define SUN_CASCADES 4
#define SKY_LEVELS 3  // of the sky volume, the finest first

SHARED_BEGIN

struct FrameData {
    mat4 view;
    mat4 projection;
    mat4 view_projection;
    mat4 inverse_view;
    mat4 inverse_projection;
    mat4 inverse_view_projection;
    vec4 eye;             // xyz world, w time in seconds
    vec4 viewport;        // width, height, 1/width, 1/height in pixels
    vec4 depth;           // x near (m), y cluster near (m), z cluster far (m), w slices / log(far/near)
    uvec4 cluster_size;   // x, y, slices; w number of local lights
    vec4 sun_direction;   // xyz unit, the direction sunlight travels; w 1 if there is a sun
    vec4 sun_illuminance; // rgb, perpendicular to the direction; lux in units of light
    mat4 sun_cascade[SUN_CASCADES];   // world to shadow texture xyz (0..1), reversed: nearer to the sun is greater
    mat4 sun_static;                  // the same for the baked map behind the cascades
    vec4 sun_cascade_far;             // view depth (m) where each cascade ends
    vec4 sun_texel;                   // world size (m) of one texel of each cascade
    vec4 sun_static_texel;            // x world size of one texel of the baked map; y 1/cascade map size; z 1/static map size;
                                      // w side of the sun's glass maps in texels, 0: no glass
    vec4 exposure;                    // x: factor from a unit of light to display; y ambient factor
    vec4 sky_level[SKY_LEVELS];       // xyz centre of the level's first cell, world (m); w cells a metre
    vec4 sky_cells;                   // xyz of a level; w number of levels
};

SHARED_END
#endif
