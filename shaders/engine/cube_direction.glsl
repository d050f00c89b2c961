#ifndef ENGINE_CUBE_DIRECTION_GLSL
#define ENGINE_CUBE_DIRECTION_GLSL

// Not normalised direction through the centre of a cube map's texel (GL 4.5 core, table 8.19); z is the face.
vec3 cube_axis_direction(ivec3 texel, int size) {
    vec2 p = (vec2(texel.xy) + 0.5) * (2.0 / float(size)) - 1.0;
    if (texel.z == 0) return vec3(1.0, -p.y, -p.x);
    if (texel.z == 1) return vec3(-1.0, -p.y, p.x);
    if (texel.z == 2) return vec3(p.x, 1.0, p.y);
    if (texel.z == 3) return vec3(p.x, -1.0, -p.y);
    if (texel.z == 4) return vec3(p.x, -p.y, 1.0);
    return vec3(-p.x, -p.y, -1.0);
}

vec3 cube_direction(ivec3 texel, int size) { return normalize(cube_axis_direction(texel, size)); }

#endif
