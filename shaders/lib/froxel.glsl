#ifndef TYNDALL_LIB_FROXEL
#define TYNDALL_LIB_FROXEL

#include "shaders/lib/depth.glsl"

// Froxels: a 3D texture aligned with the view frustum. u and v run over the screen like texture coordinates
// (NDC = 2 uv - 1), w in [0,1] over the view depths [z_near, z_far] of the volume, which need not be the camera's.
// Slice k of n holds w from k/n to (k+1)/n; its centre, where a trilinear fetch returns its texel, is (k+0.5)/n.

const int FROXEL_LINEAR = 0;  // view_depth = z_near + (z_far - z_near) w
const int FROXEL_EXPONENTIAL =
    1;  // view_depth = z_near (z_far / z_near)^w, slices in proportion to their depth; z_near > 0

const int FROXEL_LOGARITHMIC =
    2;  // view_depth = z_near ((1 + z_far / z_near)^w - 1), from 0 on: w is the logarithm of 1 + view_depth / z_near,
        // slices in proportion to their depth + z_near; z_near > 0 is where they turn from equal to proportional

const int FROXEL_TABLE = 3;  // piecewise linear, from a table: froxel_w_from_table

// A table cuts w into 16 equal segments. Entry [i / 4][i % 4] is the view depth where segment i begins, and its length
// > 0; a segment begins where the one before it ends. The two functions are each other's inverse. Outside the volume's
// depths the first and the last segment go on.
float froxel_w_from_table(float view_depth, mat4 begins, mat4 lengths) {
    vec4 sum = vec4(0.0f);
    for (int c = 0; c < 4; ++c) {
        sum += clamp((vec4(view_depth) - begins[c]) / lengths[c], vec4(0.0f), vec4(1.0f));
    }
    float before = min(view_depth - begins[0].x, 0.0f) / lengths[0].x;
    float behind = max(view_depth - begins[3].w - lengths[3].w, 0.0f) / lengths[3].w;
    return (dot(sum, vec4(1.0f)) + before + behind) / 16.0f;
}

float froxel_view_depth_from_table(float w, mat4 begins, mat4 lengths) {
    float position = 16.0f * w;
    vec4 sum = vec4(0.0f);
    for (int c = 0; c < 4; ++c) {
        vec4 index = vec4(0.0f, 1.0f, 2.0f, 3.0f) + vec4(4.0f * float(c));
        sum += lengths[c] * clamp(vec4(position) - index, vec4(0.0f), vec4(1.0f));
    }
    float before = min(position, 0.0f) * lengths[0].x;
    float behind = max(position - 16.0f, 0.0f) * lengths[3].w;
    return begins[0].x + dot(sum, vec4(1.0f)) + before + behind;
}

// Outside the volume's depths the result lies outside [0,1].
float froxel_w_from_view_depth(int distribution, float view_depth, float z_near, float z_far) {
    if (distribution == FROXEL_EXPONENTIAL) {
        return log2(max(view_depth, 1.0e-6f * z_near) / z_near) / log2(z_far / z_near);
    }
    if (distribution == FROXEL_LOGARITHMIC) {
        return log2(1.0f + max(view_depth, 0.0f) / z_near) / log2(1.0f + z_far / z_near);
    }
    return (view_depth - z_near) / (z_far - z_near);
}

float froxel_view_depth_from_w(int distribution, float w, float z_near, float z_far) {
    if (distribution == FROXEL_EXPONENTIAL) {
        return z_near * exp2(w * log2(z_far / z_near));
    }
    if (distribution == FROXEL_LOGARITHMIC) {
        return z_near * (exp2(w * log2(1.0f + z_far / z_near)) - 1.0f);
    }
    return mix(z_near, z_far, w);
}

vec3 froxel_uvw_from_view_position(vec3 view_position, int distribution, float z_near, float z_far,
                                   vec2 tan_half_fov) {
    vec3 ndc = ndc_from_view_position(view_position, tan_half_fov);
    return vec3(0.5f * ndc.x + 0.5f, 0.5f * ndc.y + 0.5f,
                froxel_w_from_view_depth(distribution, ndc.z, z_near, z_far));
}

vec3 froxel_view_position_from_uvw(vec3 uvw, int distribution, float z_near, float z_far, vec2 tan_half_fov) {
    float view_depth = froxel_view_depth_from_w(distribution, uvw.z, z_near, z_far);
    return view_position_from_ndc(vec2(2.0f * uvw.x - 1.0f, 2.0f * uvw.y - 1.0f), view_depth, tan_half_fov);
}

// Centre of a froxel; with a jitter in [-0.5, 0.5) any point inside it.
vec3 froxel_uvw_from_index(ivec3 index, vec3 jitter, ivec3 size) {
    return (vec3(index) + 0.5f + jitter) / vec3(size);
}

// The froxel that holds uvw; points outside the volume get the nearest one.
ivec3 froxel_index_from_uvw(vec3 uvw, ivec3 size) {
    return ivec3(clamp(floor(uvw * vec3(size)), vec3(0.0f), vec3(size - 1)));
}

#endif
