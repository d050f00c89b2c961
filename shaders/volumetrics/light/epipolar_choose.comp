// Which samples of a line of the sun ask the trees, and for each other one the two of them between which it is
// interpolated: one group for each line. Every `sample_step`-th asks, and so do both sides of a break of depth, that is where the
// inverse distance, linear along a plane, bends. Chosen by bits, as in "Real-Time Volumetric Shadows using 1D Min-Max
// Mipmaps" and its implementation by Yusov. And how many cells of the line its samples see.
#include "shaders/volumetrics/light/epipolar_samples.glsl"

const int MOST_SAMPLES = 2048;
const int THREADS = 64;
const int BITS = MOST_SAMPLES / THREADS;  // samples of a thread
layout(local_size_x = THREADS) in;
layout(rg16ui, binding = 0) writeonly uniform uimage2D between;
layout(r16ui, binding = 1) writeonly uniform uimage2D asking;  // of each line its samples that ask, in order
layout(rg32f, binding = 2) writeonly uniform image2D counts;    // of each line: its cells seen, its samples that ask
layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D table;
uniform int sample_step;

shared float surface[MOST_SAMPLES];  // inverse distance, 1/m
shared float radius[THREADS];         // largest distance of what is seen from the axis, m
shared uint asks[THREADS];            // a bit for each sample of a thread

float inverse_at(int i) { return i < 0 || i >= MOST_SAMPLES ? NOT_SEEN : surface[i]; }

bool bends(int i) {
    float before = inverse_at(i - 1);
    float behind = inverse_at(i + 1);
    if (before == NOT_SEEN || behind == NOT_SEEN) return true;
    return abs(before + behind - 2.0 * surface[i]) > same_surface(surface[i]);
}

void main() {
    EpipolarLines lines = epipolar_lines(table, 0);
    int line = int(gl_WorkGroupID.x);
    int begin = BITS * int(gl_LocalInvocationID.x);
    int end = line < lines.lines ? min(begin + BITS, lines.samples) : begin;
    float largest_radius = -1.0;
    for (int i = begin; i < begin + BITS; ++i) {
        vec3 direction = sample_direction(lines, ivec2(i, line));
        ivec2 pixel = i < end ? seen_pixel(direction) : ivec2(-1);
        surface[i] = NOT_SEEN;
        if (pixel.x >= 0) {
            surface[i] = inverse_distance(texelFetch(depth_texture, pixel, 0).r, direction);
            float seen = 1.0 / max(surface[i], 1.0 / volumetrics.max_distance);
            largest_radius = max(largest_radius, seen * length(cross(direction, lines.axis)));
        }
    }
    int thread = int(gl_LocalInvocationID.x);
    radius[thread] = largest_radius;
    barrier();
    uint mine = 0u;
    for (int i = begin; i < end; ++i)
        if (surface[i] != NOT_SEEN && ((i & (sample_step - 1)) == 0 || bends(i))) mine |= 1u << (i - begin);
    asks[thread] = mine;
    barrier();
    int before = 0;  // samples that ask
    for (int i = 0; i < thread; ++i) before += bitCount(asks[i]);
    if (thread == THREADS - 1) {
        for (int i = 0; i < THREADS; ++i) largest_radius = max(largest_radius, radius[i]);
        float seen = largest_radius < 0.0 ? 0.0 : floor(epipolar_sun_place(lines, largest_radius)) + 2.0;
        vec2 count = vec2(min(seen, float(lines.cells)), before + bitCount(mine));
        imageStore(counts, ivec2(line, 0), vec4(count, 0.0, 0.0));
    }
    // The first sample of the next thread's part asks, too, where it is seen.
    for (int i = begin; i < end; ++i) {
        uint own = 1u << (i - begin);
        int right = before + bitCount(mine & (own - 1u));
        bool asks_itself = (mine & own) != 0u;
        uvec2 source = surface[i] == NOT_SEEN ? uvec2(0xffffu) : uvec2(asks_itself ? right : right - 1, right);
        imageStore(between, ivec2(i, line), uvec4(source, 0u, 0u));
        if (asks_itself) imageStore(asking, ivec2(right, line), uvec4(i, 0u, 0u, 0u));
    }
}
