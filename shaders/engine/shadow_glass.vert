// Glass as shadow_depth.vert places what is opaque.
layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 color;
layout(location = 5) in mat3x4 model_rows;

uniform mat4 world_to_clip;

out vec3 world;
out vec2 surface_uv;
out vec4 vertex_color;

void main() {
    world = vec4(position, 1.0) * model_rows;
    gl_Position = world_to_clip * vec4(world, 1.0);
    surface_uv = uv;
    vertex_color = color;
}
