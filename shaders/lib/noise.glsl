#ifndef TYNDALL_LIB_NOISE
#define TYNDALL_LIB_NOISE

// Seeded noise from integer hashes: the same bits on CPU and GPU up to the float arithmetic, no table, and no
// period below 2^32 lattice cells.

// One step of a linear congruential generator, then the RXS-M-XS output permutation of PCG (O'Neill 2014); a
// bijection of 32 bits.
uint hash_uint(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

uint hash_uvec3(uvec3 v, uint seed) {
    return hash_uint(v.x + hash_uint(v.y + hash_uint(v.z + hash_uint(seed))));
}

// Uniform in [0, 1), exact in single precision.
float unit_float(uint hash) {
    return float(hash >> 8u) * (1.0f / 16777216.0f);
}

// Dot product of p with one of the 12 directions to the edges of a cube (Perlin 2002), chosen without bias: the
// hash times 12 over 2^32.
float lattice_gradient(uint hash, vec3 p) {
    uint direction = ((hash >> 16u) * 12u) >> 16u;
    uint axis = direction >> 2u;
    float a = axis == 0u ? p.y : p.x;
    float b = axis == 2u ? p.y : p.z;
    return ((direction & 1u) == 0u ? a : -a) + ((direction & 2u) == 0u ? b : -b);
}

// Gradient noise on the unit lattice, in [-1.04, 1.04], mean 0, root mean square 0.27; 0 at the lattice points,
// continuous to the second derivative.
float gradient_noise(vec3 p, uint seed) {
    vec3 cell = floor(p);
    vec3 f = p - cell;
    vec3 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    uvec3 c = uvec3(ivec3(cell));
    uint z0 = hash_uint(c.z + hash_uint(seed));
    uint z1 = hash_uint(c.z + 1u + hash_uint(seed));
    uint y00 = hash_uint(c.y + z0);
    uint y10 = hash_uint(c.y + 1u + z0);
    uint y01 = hash_uint(c.y + z1);
    uint y11 = hash_uint(c.y + 1u + z1);
    float x00 = mix(lattice_gradient(hash_uint(c.x + y00), f),
                    lattice_gradient(hash_uint(c.x + 1u + y00), f - vec3(1.0f, 0.0f, 0.0f)), w.x);
    float x10 = mix(lattice_gradient(hash_uint(c.x + y10), f - vec3(0.0f, 1.0f, 0.0f)),
                    lattice_gradient(hash_uint(c.x + 1u + y10), f - vec3(1.0f, 1.0f, 0.0f)), w.x);
    float x01 = mix(lattice_gradient(hash_uint(c.x + y01), f - vec3(0.0f, 0.0f, 1.0f)),
                    lattice_gradient(hash_uint(c.x + 1u + y01), f - vec3(1.0f, 0.0f, 1.0f)), w.x);
    float x11 = mix(lattice_gradient(hash_uint(c.x + y11), f - vec3(0.0f, 1.0f, 1.0f)),
                    lattice_gradient(hash_uint(c.x + 1u + y11), f - vec3(1.0f, 1.0f, 1.0f)), w.x);
    return mix(mix(x00, x10, w.y), mix(x01, x11, w.y), w.z);
}

// Fractional Brownian motion in [0, 1] with mean 0.5 (standard deviation 0.083 for four octaves): octaves of
// gradient noise, each of half the size and half the amplitude of the one before, and shifted so that their zeros
// do not meet. octaves >= 1.
float fbm_noise(vec3 p, int octaves, uint seed) {
    float sum = 0.0f;
    float amplitude = 1.0f;
    float total = 0.0f;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude * gradient_noise(p, seed + uint(i));
        total += amplitude;
        amplitude *= 0.5f;
        p = 2.0f * p + vec3(0.37f, 0.61f, 0.23f);
    }
    return clamp(0.5f + 0.5f * sum / total, 0.0f, 1.0f);
}

#endif
