// Local lights and their shadow tiles.
#ifndef SHARED_LIGHTS_H
#define SHARED_LIGHTS_H
#include "shaders/shared/types.h"

#define LIGHT_POINT 0
#define LIGHT_SPOT 1
#define LIGHT_SUN 2  // a point lamp at SUN_LAMP_DISTANCE, with one shadow tile
// m. Farther than half of this, a lamp is a sun: homogeneous media, which have no end, do not dim it.
#define SUN_LAMP_DISTANCE 1.0e10f

// Bits of the define GLASS: light of the sun, and of some lamp (of further suns too), comes through glass.
#define GLASS_SUN 1
#define GLASS_LAMPS 2

SHARED_BEGIN

struct GpuLight {
    vec4 position_range;    // xyz world (m), w range (m)
    vec4 intensity_radius;  // rgb candela in units of light (shaders/shared/frame.h), w radius (m): d² is clamped at radius²
    vec4 direction_type;    // xyz unit, the way it points; w LIGHT_*
    vec4 cone_shadow;       // x scale, y offset of the spot law clamp(cos * scale + offset, 0, 1)²; z first tile index, -1 = no shadow; w 1 if glass may stand before what it lights
};

// A square tile of the shadow atlas. Point lights have six in a row, ordered +X -X +Y -Y +Z -Z. A sun has one, of parallel
// light; its clip w is everywhere the distance of the sun.
struct ShadowTile {
    mat4 world_to_clip;  // reversed-Z
    vec4 rect;           // atlas uv: x, y of the lower left corner, z size, w half a texel (all in uv)
    vec4 depth;          // x near (m), y far (m), z world size of one texel at 1 m, w 1 if the tile holds a rendered map
};

struct ClusterRange {
    uint offset;  // into the cluster light list
    uint count;
};

SHARED_END
#endif
