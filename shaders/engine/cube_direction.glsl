#ifndef ENGINE_CUBE_DIRECTION_GLSL
#define ENGINE_CUBE_DIRECTION_GLSL

// Not normalised direction through the centre of a cube map's texel (GL 4.5 core, table 8.19); z is the face. In the
// subset of GLSL that C++ compiles too (shaders/lib/glm_subset.h).
vec3 cube_axis_direction(ivec3 texel, int size) {
    vec2 p = (vec2(float(texel.x), float(texel.y)) + 0.5f) * (2.0f / float(size)) - 1.0f;
    if (texel.z == 0) {
        return vec3(1.0f, -p.y, -p.x);
    }
    if (texel.z == 1) {
        return vec3(-1.0f, -p.y, p.x);
    }
    if (texel.z == 2) {
        return vec3(p.x, 1.0f, p.y);
    }
    if (texel.z == 3) {
        return vec3(p.x, -1.0f, -p.y);
    }
    if (texel.z == 4) {
        return vec3(p.x, -p.y, 1.0f);
    }
    return vec3(-p.x, -p.y, -1.0f);
}

vec3 cube_direction(ivec3 texel, int size) {
    return normalize(cube_axis_direction(texel, size));
}

#endif
