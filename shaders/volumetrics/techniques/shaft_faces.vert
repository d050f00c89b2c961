// Faces of the volume that the sun does not reach: an instance is the strip between two columns of shaft_mesh.comp's image.
// Counter-clockwise from outside.
#include "shaders/volumetrics/frame/ray.glsl"

layout(binding = 0) uniform sampler2D shaft_vertices;
uniform mat4 relative_to_clip;  // from positions relative to the eye

void main() {
    ivec2 cell = ivec2(gl_InstanceID + 1 - (gl_VertexID & 1), gl_VertexID >> 1);
    gl_Position = target_clip(relative_to_clip * vec4(texelFetch(shaft_vertices, cell, 0).xyz, 1.0));
}
