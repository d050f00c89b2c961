// Numbers that the shadow passes (C++) and shaders/engine/shadow_lookup.glsl must agree on.
#ifndef SHARED_SHADOWS_H
#define SHARED_SHADOWS_H

// A cascade is mixed with the next one over this last part of its view depth; the next one begins that much earlier.
#define SUN_CASCADE_BLEND 0.1f
// Surface lookups take 2x2 bilinear taps half a texel off centre: they read up to this many texels from the centre.
#define SHADOW_FILTER_RADIUS 1.5f
// Texels round an atlas tile's light cone or cube face that are drawn for the filter alone.
#define SHADOW_TILE_BORDER 2

#endif
