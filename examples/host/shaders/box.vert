// A box without vertex buffers: 36 vertices.
layout(location = 0) uniform vec3 center;
layout(location = 1) uniform vec3 half_size;
layout(location = 2) uniform bool into_shadow_map;
out vec3 world;
out vec3 normal;

void main() {
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    int face = gl_VertexID / 6, axis = face % 3;
    vec2 corner = corners[gl_VertexID % 6];
    normal = vec3(0.0);
    normal[axis] = face < 3 ? 1.0 : -1.0;
    vec3 place = normal;
    place[(axis + 1) % 3] = corner.x;
    place[(axis + 2) % 3] = corner.y;
    world = center + half_size * place;
    vec4 shadow = host_world_to_shadow * vec4(world, 1.0);
    gl_Position = into_shadow_map ? vec4(2.0 * shadow.xy - 1.0, shadow.zw) : host_world_to_clip * vec4(world, 1.0);
}
