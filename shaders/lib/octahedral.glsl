#ifndef TYNDALL_LIB_OCTAHEDRAL
#define TYNDALL_LIB_OCTAHEDRAL

// Unit vectors on a square (Meyer et al. 2010, "On Floating-Point Normal Vectors"): the sphere is projected onto the
// octahedron |x| + |y| + |z| = 1, whose lower half (z < 0) is folded outwards over the upper one.

float octahedral_sign(float v) {
    return v < 0.0f ? -1.0f : 1.0f;
}

// Unit vector to [0,1]^2.
vec2 octahedral_encode(vec3 n) {
    float scale = 1.0f / (abs(n.x) + abs(n.y) + abs(n.z));
    float u = n.x * scale;
    float v = n.y * scale;
    if (n.z < 0.0f) {
        float folded = (1.0f - abs(v)) * octahedral_sign(u);
        v = (1.0f - abs(u)) * octahedral_sign(v);
        u = folded;
    }
    return vec2(0.5f * u + 0.5f, 0.5f * v + 0.5f);
}

// [0,1]^2 to a unit vector. At 16 bits a channel the error is below 0.005 degrees.
vec3 octahedral_decode(vec2 e) {
    float u = 2.0f * e.x - 1.0f;
    float v = 2.0f * e.y - 1.0f;
    float z = 1.0f - abs(u) - abs(v);
    float fold = max(-z, 0.0f);
    return normalize(vec3(u - fold * octahedral_sign(u), v - fold * octahedral_sign(v), z));
}

#endif
