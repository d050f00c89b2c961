// Depth of shadow casters. world_to_clip is a sun map's or a lamp tile's.
#extension GL_ARB_shader_draw_parameters : require
#include "shaders/shared/bindings.h"

layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 color;

layout(std430, binding = BINDING_INSTANCES) readonly buffer InstanceBuffer { mat4 instances[]; };
layout(std430, binding = BINDING_VISIBLE_INSTANCES) readonly buffer VisibleBuffer { uint visible_instances[]; };
uniform mat4 world_to_clip;

#if ALPHA_MASK
out vec2 surface_uv;
out float vertex_alpha;
#endif

void main() {
    mat4 model = instances[visible_instances[gl_BaseInstanceARB + gl_InstanceID]];
    gl_Position = world_to_clip * (model * vec4(position, 1.0));
#if ALPHA_MASK
    surface_uv = uv;
    vertex_alpha = color.a;
#endif
}
