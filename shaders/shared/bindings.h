// Binding points, one home for both languages.
#ifndef SHARED_BINDINGS_H
#define SHARED_BINDINGS_H

// Uniform blocks
#define BINDING_FRAME 0
#define BINDING_VOLUMETRICS 1

// Storage buffers
#define BINDING_INSTANCES 0
#define BINDING_LIGHTS 1
#define BINDING_CLUSTERS 2
#define BINDING_CLUSTER_LIGHTS 3
#define BINDING_SHADOW_TILES 4
#define BINDING_VISIBLE_LIGHTS 5
#define BINDING_VISIBLE_INSTANCES 6
#define BINDING_LOCAL_MEDIA 7
#define BINDING_NOISE 8
#define BINDING_MEDIA_TILES 9
#define BINDING_UNFINISHED 10
#define BINDING_SPRITES 11
#define BINDING_LAMP_VOLUMES 12
#define BINDING_PARTICLES 13
#define BINDING_PREVIOUS_INSTANCES 14
#define BINDING_WORK 15

// Texture units of the lighting contract; passes use units 0-7 for their own textures.
#define UNIT_SUN_CASCADES 8
#define UNIT_SUN_STATIC 9
#define UNIT_SHADOW_ATLAS 10
#define UNIT_AMBIENT 11
#define UNIT_SUN_VOLUME 12
#define UNIT_LAMP_VOLUMES 13
#define UNIT_NOISE 5

// What shaders/volumetrics/frame/apply.glsl samples, beside the textures of the pass that includes it.
#define UNIT_FOG_COLUMNS 6
#define UNIT_FOG_RADIANCE 7
#define UNIT_FOG_OPTICAL_DEPTH 14

#endif
