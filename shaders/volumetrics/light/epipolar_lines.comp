// The lines of one light, see epipolar.glsl: one group for each. Of a line of n cells nodes n .. 2n - 1 are its cells and
// node i has the children 2i and 2i + 1; each holds the smallest and the largest slope. Node 0 holds how many cells are made,
// of a line with samples those that they see, and with GLASS in y 1 where some of the sun's light has come through glass.
#include "shaders/interface/lights.glsl"
#include "shaders/interface/shadow_maps.glsl"
#include "shaders/volumetrics/frame/data.glsl"
#include "shaders/volumetrics/light/epipolar.glsl"

const int MOST_CELLS = 2048;
const int THREADS = 64;
layout(local_size_x = THREADS) in;
layout(rg32f, binding = 0) writeonly uniform image2D nodes;
layout(binding = 0) uniform sampler2D table;
layout(binding = 1) uniform sampler2D cells_seen;  // of the sun's lines
uniform int light;    // 0 the sun (SUN 1), 1 + i lamp i
uniform bool sampled;  // the lines have samples

shared vec2 node[MOST_CELLS];
#if GLASS
shared uint glass;
#endif

#if SUN
float slope_of(EpipolarLines lines, vec3 across, float place) {
    float radius = EPIPOLAR_RADIUS * (exp(place / lines.cells_per_unit) - 1.0);
    vec3 world = volumetrics.eye.xyz + across * radius;
#if GLASS
    count_work(WORK_TEXTURE_FETCHES, 1u);
    if (sun_ray_meets_glass(world)) glass = 1u;
#endif
    float height = sun_occluder(world);
    return height > -0.5 * NO_OCCLUDER ? height / radius : -EPIPOLAR_LARGEST;
}
#else
// Of a lamp, and of a further sun.
float slope_of(EpipolarLines lines, vec3 across, float place) {
    GpuLight lamp = light_at(uint(light - 1));
    float radius = EPIPOLAR_RADIUS * (exp(place / lines.cells_per_unit) - 1.0);
    float angle = place / lines.cells_per_unit;
    float cosine = cos(angle);
    float sine = sin(angle);
    bool parallel = lines.distance == 0.0;
    vec3 world = parallel ? volumetrics.eye.xyz + across * radius
                          : lamp.position_range.xyz + sine * across - cosine * lines.axis;
    float height = light_occluder(uint(light - 1), lamp, world);
    if (parallel) return height > -0.5 * NO_OCCLUDER ? height / radius : -EPIPOLAR_LARGEST;
    float reach = 1.0 - height;
    float range = lamp.position_range.w > 0.0 ? lamp.position_range.w : 0.5 * NO_OCCLUDER;
    if (reach >= range) return -EPIPOLAR_LARGEST;  // wherever a view ray crosses it
    return (lines.distance - reach * cosine) / max(reach * sine, 1.0e-9);
}
#endif

// Makes a tree of `count` nodes of a level of `level` nodes, which lie `stride` apart in `node` from `first` on; leaves its
// root at `first`. What begins behind `made` of all cells, a share of them, is not stored.
void merge(int root, int first, int count, int stride, int level, float made) {
    int begin = first / stride;  // of the nodes in their level
    while (count > 1) {
        count /= 2;
        level /= 2;
        begin /= 2;
        for (int i = 0; i < count; ++i) {
            vec2 a = node[first + 2 * i * stride];
            vec2 b = node[first + (2 * i + 1) * stride];
            vec2 merged = vec2(min(a.x, b.x), max(a.y, b.y));
            node[first + i * stride] = merged;
            if (float(begin + i) < made * float(level))
                imageStore(nodes, epipolar_texel(root + level + begin + i), vec4(merged, 0.0, 0.0));
        }
    }
}

void main() {
    EpipolarLines lines = epipolar_lines(table, light);
    int line = int(gl_WorkGroupID.x);
    int thread = int(gl_LocalInvocationID.x);
    float angle = (float(line) + 0.5) / lines.lines_per_radian;
    vec3 across = cos(angle) * lines.first + sin(angle) * cross(lines.axis, lines.first);
    int root = lines.nodes + line * 2 * lines.cells;

    int made = sampled ? int(texelFetch(cells_seen, ivec2(line, 0), 0).x) : lines.cells;
    float share_made = float(made) / float(lines.cells);
#if GLASS
    if (thread == 0) glass = 0u;
    barrier();
#endif
    // Neighbouring threads take neighbouring cells, which ask the same maps.
    for (int cell = thread; cell < lines.cells; cell += THREADS) {
        node[cell] = vec2(EPIPOLAR_LARGEST, -EPIPOLAR_LARGEST);
        if (cell >= made) continue;
        count_work(WORK_SHADOW_LOOKUPS, 1u);
        node[cell] = vec2(clamp(slope_of(lines, across, float(cell) + 0.5), -EPIPOLAR_LARGEST, EPIPOLAR_LARGEST));
        imageStore(nodes, epipolar_texel(root + lines.cells + cell), vec4(node[cell], 0.0, 0.0));
    }
    barrier();
    int part = max(lines.cells / THREADS, 1);  // cells of a thread
    int parts = lines.cells / part;
    if (thread < parts && thread * part < made) merge(root, thread * part, part, 1, lines.cells, share_made);
    barrier();
    float coloured = 0.0;
#if GLASS
    coloured = float(glass);
#endif
    if (thread == 0) imageStore(nodes, epipolar_texel(root), vec4(float(made), coloured, 0.0, 0.0));
    if (thread == 0 && made > 0) merge(root, 0, parts, part, parts, share_made);
    flush_work();
}
