// The volumetrics module's uniform block and local media.
#ifndef SHARED_VOLUMETRICS_H
#define SHARED_VOLUMETRICS_H
#include "shaders/shared/types.h"

#define MAX_HEIGHT_MEDIA 4
#define MAX_FEW_LAMPS 8

// volumetrics::Shape.
#define SHAPE_ELLIPSOID 0
#define SHAPE_BOX 1
#define SHAPE_GRID 2

// Density grids (grid.glsl): levels of detail, and words of a grid's header in the page table.
#define GRID_LEVELS 12
#define GRID_HEADER 32  // its number of levels, then of each level where its pages begin and its bricks along x | y << 10 | z << 20
#define MAX_GRIDS 8     // that dim light
#define GRID_SIDE 8     // voxels of a brick, without those of the next one that it repeats
#define GRID_ROW_BITS 12  // of the page table's texture

// Tiles of the screen, each with a list of the local media that may be seen in it (ray_media.glsl).
#define SCREEN_MEDIA_X 32
#define SCREEN_MEDIA_Y 18

// Settings noise and noise_time, in their order.
#define NOISE_NONE 0
#define NOISE_BAYER 1
#define NOISE_WHITE 2
#define NOISE_WHITE_TILE 3
#define NOISE_IGN 4
#define NOISE_BLUE 5
#define NOISE_STBN 6
#define NOISE_FAST 7
#define NOISE_TIME_FIXED 0
#define NOISE_TIME_OWN 1
#define NOISE_TIME_GOLDEN_RATIO 2
#define NOISE_TIME_R2 3
#define NOISE_TILE_OFFSETS 256  // of the largest tile
#define NOISE_TEXTURE_SIDE 128
#define NOISE_TEXTURE_SLICES 32

#define FOG_LINEAR 0
#define FOG_SQUARED 1
#define FOG_EXPONENTIAL 2
#define FOG_HEIGHT 3

SHARED_BEGIN

struct HeightMedium {
    vec4 sigma_s_base;     // rgb 1/m at density 1, w base (m)
    vec4 sigma_t_falloff;  // rgb 1/m at density 1, w falloff (m)
    vec4 emission_g;       // rgb radiance per metre at density 1, w anisotropy
    vec4 sigma_s_rayleigh; // rgb 1/m at density 1: the part of sigma_s with Rayleigh's phase function
};

struct LocalMedium {
    mat4 world_to_shape;   // world to the shape's centre frame in metres (rotation and translation only)
    vec4 extent_softness;  // xyz half the size of the box round the shape, in its frame (m), w softness (m)
    vec4 sigma_s_g;        // rgb 1/m at density 1, w anisotropy
    vec4 sigma_a_shape;    // rgb 1/m at density 1, w SHAPE_*
    vec4 emission_noise;   // rgb radiance per metre at density 1, w noise amount 0..1
    vec4 noise_height;     // x noise scale (m), z base (m), w falloff (m); falloff 0 = no height profile
    uvec4 seed_grid;       // x seed of the noise; shape grid: y its place in the page table, z 1: nearest, w tells grids apart
    vec4 grid_x;           // shape grid: of a point p of the shape, dot(grid_x, (p, 1)) is the x of its voxel
    vec4 grid_y;
    vec4 grid_z;
    vec4 grid_value;       // x density of the greatest value
};

// What a density grid leaves of the sun's light: its part of a volume (light_transmittance.glsl).
struct GridSun {
    mat4 world_to_volume;  // to texture xyz
    vec4 low;              // of the part, texture xyz: centres of the outermost texels
    vec4 high;
    vec4 sigma_t;          // rgb 1/m at density 1
};

struct VolumetricsData {
    mat4 inverse_projection;
    mat4 inverse_view;
    vec4 eye;                   // xyz world, w near (m)
    vec4 viewport;              // width, height, 1/width, 1/height of the depth buffer, px
    vec4 target;                // of what is drawn to at the chosen resolution: width, height, px; zw screen (0..1) per px of it
    vec4 homogeneous_sigma_s;   // rgb 1/m, w anisotropy (weighted by scattering over the homogeneous media, Rayleigh's left out)
    vec4 homogeneous_sigma_t;   // rgb 1/m
    vec4 homogeneous_emission;  // rgb radiance per metre
    vec4 homogeneous_rayleigh;  // rgb 1/m: the part of sigma_s with Rayleigh's phase function
    uint height_media_count;
    uint local_media_count;
    uint steps;                 // of the march
    uint noise_side;            // of the noise tile (px), 1: none
    uvec4 noise;                // x NOISE_*, y NOISE_TIME_*, z frame
    uint phase;                 // PHASE_*
    uint light_transmittance;   // 1: light is attenuated on its way in
    uint has_ambient;
    uint froxel_distribution;   // FROXEL_*
    float max_distance;         // of the march, m
    float first_step;           // / length of the ray
    float step_growth;          // each step / the one before
    uint coloured_froxels;      // 1: froxels have an optical depth by channel
    float second_anisotropy;    // of the second lobe (PHASE_DOUBLE_HENYEY_GREENSTEIN, PHASE_HG_DRAINE)
    float second_weight;
    uint local_emission;        // 1: some local medium emits
    uint fog_mode;              // FOG_*
    float radial_samples;       // to the light
    float radial_decay;         // weight at the light
    float radial_unseen;        // visibility of an unseen sun
    uint local_noise;           // 1: some local medium has noise
    vec4 froxel_depths;         // x nearest, y farthest view depth (m) of the froxel volume
    uint has_global;            // 1: some medium fills space
    uint further_suns;          // the first of the lamps
    uint loop_rounds;           // of all loops of a shader, after which the driver ends them
    uint grid_suns;             // of grid_sun
    uint scattering_orders;     // of sunlight in density grids
    float second_alpha;         // of the second lobe
    float droplet_anisotropy;   // of the first lobe, whatever the medium (PHASE_HG_DRAINE)
    float grid_piece;           // length of the pieces of grids, voxels or pixels
    uint few_lamp_count;
    float lamp_core;            // of the many lamps: radius of the core / view depth, see lamp_cores.frag
    float lamp_core_slices;     // half of its least thickness along the view, as a share of all slices
    uint unused_1;
    uvec4 few_lamps[MAX_FEW_LAMPS / 4];  // technique auto: lamps that pixels take one by one, the others are in froxels; ~0: none
    mat4 froxel_begins;         // FROXEL_TABLE: view depth (m) where each of 16 equal shares of the slices begins
    mat4 froxel_lengths;        // and their lengths (m); entry i is [i / 4][i % 4]
    mat4 world_to_sun_volume;   // world to texture xyz of the sun volume, see light_transmittance.glsl
    vec4 lamp_volumes;          // x directions across and y distances of a lamp's volume, zw 1 / size of the atlas, texels
    HeightMedium height[MAX_HEIGHT_MEDIA];
    GridSun grid_sun[MAX_GRIDS];
};

SHARED_END
#endif
