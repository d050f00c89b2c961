// Depth of shadow casters. world_to_clip is a sun map's or a lamp tile's.
layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 color;
layout(location = 5) in mat3x4 model_rows;  // of the instance: rows of the affine model matrix

uniform mat4 world_to_clip;

#if ALPHA_MASK
out vec2 surface_uv;
out float vertex_alpha;
#endif

void main() {
    gl_Position = world_to_clip * vec4(vec4(position, 1.0) * model_rows, 1.0);
#if ALPHA_MASK
    surface_uv = uv;
    vertex_alpha = color.a;
#endif
}
