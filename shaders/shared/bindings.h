// Binding points, one home for both languages. OpenGL 4.5 promises 8 storage buffers and 16 texture units: numbers stay
// below, and programs that never meet share them. What is shared is bound anew by each pass that reads it; a test holds
// every permutation to the limits.
#ifndef SHARED_BINDINGS_H
#define SHARED_BINDINGS_H

// Uniform blocks
#define BINDING_FRAME 0
#define BINDING_VOLUMETRICS 1
#define BINDING_NOISE 2  // volumetrics: noise_offset.glsl

// Storage buffers. 1 and 2, like the images below, are what lights are read from (shaders/interface): bound together for
// every lit pass.
#define BINDING_PARTICLES 0           // transparent particles
#define BINDING_SPRITES 0             // volumetrics: billboards, particles
#define BINDING_MEDIA_TILES 0         // volumetrics: inject_media
#define BINDING_TRANSPARENT_DEPTHS 0  // volumetrics: froxel_columns
#define BINDING_SCREEN_MEDIA 0        // volumetrics: ray_media.glsl
#define BINDING_UNFINISHED 0          // volumetrics: reference_lamps
#define BINDING_CLUSTERS 1
#define BINDING_CLUSTER_LIGHTS 2
#define BINDING_VISIBLE_ROWS 3        // light culling, clusters
#define BINDING_LAMP_VOLUMES 5        // whatever is lit through local media
#define BINDING_VISIBLE_LIGHTS 5      // light culling, clusters
#define BINDING_PREVIOUS_INSTANCES 5  // geometry: G-buffer with motion
#define BINDING_LOCAL_MEDIA 6         // volumetrics: local_media.glsl
#define BINDING_WORK 7                // every pass that counts its work

// Image units. 0 to 3 are a pass's own.
#define IMAGE_LIGHTS 6
#define IMAGE_SHADOW_TILES 7

// Texture units. 0 to 7 are a pass's own: a geometry pass's material is 0 to 4, the sky it mirrors 5. A pass that
// includes shaders/volumetrics/frame/apply.glsl leaves 6 and 7 to it, one of local media 4 and 5 to their grids.
#define UNIT_GRID_PAGES 4  // and 5: grid.glsl
#define UNIT_GRID_BRICKS 5
#define UNIT_NOISE 6         // noise_offset.glsl
#define UNIT_EPIPOLAR 6      // and 7: epipolar_rays.glsl
#define UNIT_FOG_COLUMNS 6
#define UNIT_FOG_RADIANCE 7
#define UNIT_SUN_GLASS 7       // 7 and 15: glass_lookup.glsl, beside 8 to 11 where no fog is applied
#define UNIT_SUN_CASCADES 8       // 8 to 11: what lights are read from
#define UNIT_SUN_STATIC 9
#define UNIT_SHADOW_ATLAS 10
#define UNIT_AMBIENT 11
#define UNIT_SUN_VOLUME 12        // 12 to 14: light_transmittance.glsl
#define UNIT_LAMP_VOLUMES 13
#define UNIT_GRID_SUN 14          // light_transmittance.glsl
#define UNIT_FOG_OPTICAL_DEPTH 15 // apply.glsl
#define UNIT_LAMP_GLASS 15

#endif
