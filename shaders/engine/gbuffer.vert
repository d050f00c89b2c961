#extension GL_ARB_shader_draw_parameters : require
#include "shaders/engine/frame_block.glsl"

layout(std430, binding = BINDING_INSTANCES) readonly buffer InstanceBuffer { mat4 models[]; };
layout(std430, binding = BINDING_VISIBLE_INSTANCES) readonly buffer VisibleBuffer { uint visible_instances[]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 texcoord;
layout(location = 4) in vec4 color;

uniform float handedness;  // -1 where the model matrix mirrors

layout(location = 0) out vec3 world_normal;
layout(location = 1) out vec4 world_tangent;
layout(location = 2) out vec2 uv;
layout(location = 3) out vec4 vertex_color;
#if MOTION
layout(std430, binding = BINDING_PREVIOUS_INSTANCES) readonly buffer PreviousInstanceBuffer { mat4 previous_models[]; };
uniform mat4 u_previous_view_projection;
layout(location = 4) out vec3 clip_now;     // xyw
layout(location = 5) out vec3 clip_before;  // of the same point of the surface in the frame before
#endif

void main() {
    mat4 model = models[visible_instances[gl_BaseInstanceARB + gl_InstanceID]];
    vec3 largest = max(max(abs(model[0].xyz), abs(model[1].xyz)), abs(model[2].xyz));
    // Its size does not matter to directions, and squares of a small one would vanish.
    mat3 m = mat3(model) / max(max(largest.x, largest.y), max(largest.z, 1.0e-30));
    // The cofactor matrix is det(m) times the inverse transpose: it carries normals, and exists for any scale.
    mat3 cofactor = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    world_normal = handedness * (cofactor * normal);
    world_tangent = vec4(m * tangent.xyz, handedness * tangent.w);
    uv = texcoord;
    vertex_color = color;
    gl_Position = frame.view_projection * (model * vec4(position, 1.0));
#if MOTION
    mat4 previous_model = previous_models[visible_instances[gl_BaseInstanceARB + gl_InstanceID]];
    clip_now = gl_Position.xyw;
    clip_before = (u_previous_view_projection * (previous_model * vec4(position, 1.0))).xyw;
#endif
}
