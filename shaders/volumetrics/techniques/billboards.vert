// Four corners of a camera-facing billboard, drawn as a strip, one instance each. Its depth is that of its front: where
// that is hidden the whole slab is.
#include "shaders/interface/lights.glsl"
#include "shaders/shared/sprites.h"
#include "shaders/volumetrics/frame/ray.glsl"

layout(std430, binding = BINDING_SPRITES) readonly buffer BillboardBuffer { Billboard billboards[]; };

layout(location = 0) flat out vec3 ambient;
layout(location = 1) flat out vec3 slab;

void main() {
    Billboard billboard = billboards[gl_InstanceID];
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    float near = volumetrics.eye.w;
    gl_Position = target_clip(vec4(mix(billboard.rect.xy, billboard.rect.zw, corner), near / max(billboard.slab.x, near), 1.0));
    ambient = volumetrics.has_ambient != 0u ? ambient_radiance() : vec3(0.0);
    slab = billboard.slab.xyz;
}
