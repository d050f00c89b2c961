#include "shaders/engine/frame_block.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 texcoord;
layout(location = 4) in vec4 color;
layout(location = 5) in mat3x4 model_rows;  // of the instance: rows of the affine model matrix

uniform float handedness;  // -1 where the model matrix mirrors

layout(location = 0) out vec3 world_normal;
layout(location = 1) out vec4 world_tangent;
layout(location = 2) out vec2 uv;
layout(location = 3) out vec4 vertex_color;
#if MOTION
layout(location = 8) in uint instance;
layout(std430, binding = BINDING_PREVIOUS_INSTANCES) readonly buffer PreviousInstanceBuffer { mat4 previous_models[]; };
uniform mat4 u_previous_view_projection;
layout(location = 4) out vec3 clip_now;     // xyw
layout(location = 5) out vec3 clip_before;  // of the same point of the surface in the frame before
#endif

void main() {
    mat4x3 model = transpose(model_rows);
    vec3 largest = max(max(abs(model[0]), abs(model[1])), abs(model[2]));
    // Its size does not matter to directions, and squares of a small one would vanish.
    mat3 m = mat3(model) / max(max(largest.x, largest.y), max(largest.z, 1.0e-30));
    // The cofactor matrix is det(m) times the inverse transpose: it carries normals, and exists for any scale.
    mat3 cofactor = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    world_normal = handedness * (cofactor * normal);
    world_tangent = vec4(m * tangent.xyz, handedness * tangent.w);
    uv = texcoord;
    vertex_color = color;
    gl_Position = frame.view_projection * vec4(model * vec4(position, 1.0), 1.0);
#if MOTION
    clip_now = gl_Position.xyw;
    clip_before = (u_previous_view_projection * (previous_models[instance] * vec4(position, 1.0))).xyw;
#endif
}
