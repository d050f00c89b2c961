// Density grids: sparse bricks of 8^3 voxels in one texture, found through a table of pages; levels of detail, each the mean
// over 2^3 voxels of the one before. modules/volumetrics/src/media/grid_atlas.h makes both.
//
// Places are voxel coordinates: voxel centres at whole numbers, voxel 0 the lowest that holds something. In a level k the
// texel q = (p + 1/2) / 2^k + 1/2, so that one voxel before the grid has a place too.
#ifndef VOLUMETRICS_GRID_GLSL
#define VOLUMETRICS_GRID_GLSL

#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/data.glsl"

layout(binding = UNIT_GRID_PAGES) uniform usampler2D grid_pages;
layout(binding = UNIT_GRID_BRICKS) uniform sampler3D grid_bricks;

uint grid_word(uint index) {
    count_work(WORK_GRID_PAGE_READS, 1u);
    return texelFetch(grid_pages, ivec2(index & ((1u << GRID_ROW_BITS) - 1u), index >> GRID_ROW_BITS), 0).r;
}

struct GridLevel {
    uint pages;     // where they begin
    ivec3 bricks;   // along the axes
    float scale;    // 1 / voxels of a texel along an axis
    bool nearest;
};

int grid_level_count(LocalMedium medium) { return int(grid_word(uint(GRID_HEADER) * medium.seed_grid.y)); }

GridLevel grid_level(LocalMedium medium, int level) {
    uint header = uint(GRID_HEADER) * medium.seed_grid.y;
    uint size = grid_word(header + 2u + 2u * uint(level));
    return GridLevel(grid_word(header + 1u + 2u * uint(level)), ivec3((uvec3(size) >> uvec3(0u, 10u, 20u)) & 1023u),
                     exp2(-float(level)), medium.seed_grid.z != 0u);
}

vec3 to_voxel(LocalMedium medium, vec4 p) { return vec3(dot(medium.grid_x, p), dot(medium.grid_y, p), dot(medium.grid_z, p)); }

// 0: all of the brick is empty.
uint grid_page(GridLevel level, ivec3 brick) {
    if (any(lessThan(brick, ivec3(0))) || any(greaterThanEqual(brick, level.bricks))) return 0u;
    return grid_word(level.pages + uint(brick.x + level.bricks.x * (brick.y + level.bricks.y * brick.z)));
}

// 0..1, in parts of the greatest value.
float grid_value(GridLevel level, vec3 voxel) {
    vec3 q = (voxel + 0.5) * level.scale + 0.5;
    if (level.nearest) q = floor(q + 0.5);
    ivec3 brick = ivec3(floor(q * (1.0 / float(GRID_SIDE))));
    uint page = grid_page(level, brick);
    if (page == 0u) return 0.0;
    count_work(WORK_GRID_READS, 1u);
    vec3 corner = vec3((uvec3(page) >> uvec3(0u, 10u, 20u)) & 1023u) * float(GRID_SIDE + 1);
    return textureLod(grid_bricks, (corner + q - vec3(brick * GRID_SIDE) + 0.5) / vec3(textureSize(grid_bricks, 0)), 0.0).r;
}

// What is left of the line o + d t of the shape, from t on, of the empty brick that it is in there; 0: the brick is not empty.
float grid_empty_ahead(LocalMedium medium, vec3 o, vec3 d, float t) {
    vec3 voxel = to_voxel(medium, vec4(o + d * t, 1.0));
    vec3 along = to_voxel(medium, vec4(d, 0.0));
    for (int i = min(grid_level_count(medium) - 1, 2); i >= 0; i -= 2) {
        GridLevel level = grid_level(medium, i);
        vec3 q = ((voxel + 0.5) * level.scale + 0.5) / float(GRID_SIDE);
        ivec3 brick = ivec3(floor(q));
        if (grid_page(level, brick) != 0u) continue;
        vec3 dq = along * (level.scale / float(GRID_SIDE));
        vec3 leave = (vec3(brick) + step(0.0, dq) - q) / mix(dq, vec3(1.0e-20), equal(dq, vec3(0.0)));
        return max(min(leave.x, min(leave.y, leave.z)), 0.0);
    }
    return 0.0;
}

// At a point of the shape.
float grid_density(LocalMedium medium, vec3 p) {
    return medium.grid_value.x * grid_value(grid_level(medium, 0), to_voxel(medium, vec4(p, 1.0)));
}

// Mean over [begin, end] of the line o + d t of the shape and `width` metres across, from `most` samples at most: of the
// finest level whose texels are not wider than that, nor closer than the samples.
float grid_mean(LocalMedium medium, vec3 o, vec3 d, float begin, float end, float width, int most) {
    vec3 from = to_voxel(medium, vec4(o + d * begin, 1.0));
    vec3 along = to_voxel(medium, vec4(d, 0.0));  // voxels a metre
    float voxels = length(along) * (end - begin);
    float coarseness = max(ceil(log2(max(voxels / float(most), 1.0))), floor(log2(max(length(along) * width, 1.0))));
    GridLevel level = grid_level(medium, min(int(coarseness), grid_level_count(medium) - 1));
    float samples = level.nearest ? 4.0 : 1.0;  // of a texel
    int count = clamp(int(ceil(samples * voxels * level.scale)), 1, most);
    vec3 stride = along * ((end - begin) / float(count));
    float sum = 0.0;
    for (int i = 0; i < count; ++i) sum += grid_value(level, from + stride * (float(i) + 0.5));
    return medium.grid_value.x * sum / float(count);
}

#endif
