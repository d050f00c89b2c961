#ifndef TYNDALL_LIB_PACK
#define TYNDALL_LIB_PACK

// The largest finite half-precision number.
const float HALF_MAX = 65504.0f;

// The nearest numbers that half precision holds, limited to +-HALF_MAX. To be called before a store to a 16-bit
// float texture: some drivers truncate there, which biases whatever accumulates.
vec4 round_to_half(vec4 v) {
    vec4 limited = clamp(v, vec4(-HALF_MAX), vec4(HALF_MAX));
    vec2 xy = unpackHalf2x16(packHalf2x16(vec2(limited.x, limited.y)));
    vec2 zw = unpackHalf2x16(packHalf2x16(vec2(limited.z, limited.w)));
    return vec4(xy.x, xy.y, zw.x, zw.y);
}

#endif
