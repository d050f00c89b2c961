// The radius of lamps' 1 / max(d^2, radius^2).
#ifndef VOLUMETRICS_LAMP_CORE_GLSL
#define VOLUMETRICS_LAMP_CORE_GLSL

#include "shaders/interface/lights.glsl"
#include "shaders/volumetrics/media/froxel_depths.glsl"

// Within which 1/d^2 does not rise, m.
#ifndef LAMP_RADIUS
#define LAMP_RADIUS(light) light.intensity_radius.w
#endif

// Froxels cannot hold the peak of a lamp's 1/d^2 that is no wider than they are. They have it cut off within the core, a ball round the
// lamp, and pixels add what was cut off (lamp_cores.frag): two laws with two radii, whose difference is 0 beyond the core. 0:
// the lamp has none, for it is behind the eye or a further sun.
float core_radius(GpuLight light) {
    float depth = dot(volumetrics.inverse_view[2].xyz, volumetrics.eye.xyz - light.position_range.xyz);
    if (depth <= volumetrics.eye.w || depth > froxel_far()) return 0.0;
    float w = froxel_w(depth);
    float slices = froxel_view_depth(min(w + volumetrics.lamp_core_slices, 1.0)) -
                   froxel_view_depth(max(w - volumetrics.lamp_core_slices, 0.0));
    float radius = max(volumetrics.lamp_core * depth, slices);
    return light.position_range.w > 0.0 ? min(radius, 0.5 * light.position_range.w) : radius;
}

#endif
