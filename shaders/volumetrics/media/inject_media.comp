// Fills the froxel volume with the local media: sums of sigma_s, sigma_t and emission, each in the mean over the part of the
// column's ray that lies in the froxel, so that nothing is lost between slices, however thin. The anisotropy is stored as its
// product with the mean sigma_s, so that filtering averages it by scattering.
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/data.glsl"
#include "shaders/volumetrics/media/froxel_depths.glsl"
#include "shaders/volumetrics/media/local_media.glsl"
#include "shaders/volumetrics/frame/ray.glsl"

// One group is one tile that holds media, see modules/volumetrics/src/media/froxel_tiles.h. The volume was cleared before.
layout(local_size_x = 16, local_size_y = 16) in;

// Per tile: x | y << 10 | z << 20, then a bit for each medium that may touch it, in words of 32.
layout(std430, binding = BINDING_MEDIA_TILES) readonly buffer MediaTileBuffer { uint media_tiles[]; };
uniform uint tile_count;

layout(binding = 0) uniform sampler2D farthest_view_depth;
layout(rgba16f, binding = 0) writeonly uniform image3D froxel_scattering;
layout(rgba16f, binding = 1) writeonly uniform image3D froxel_extinction;
#if EMISSION
layout(rgba16f, binding = 2) writeonly uniform image3D froxel_emission;
#endif

const int MOST_SAMPLES = 8;  // of a medium's noise or grid in a froxel

// Behind what a column and those around it see nobody looks.
bool is_seen(ivec3 froxel, ivec3 size) {
    float begin = froxel_slice_begin(froxel.z, size.z);
    for (int i = 0; i < 9; ++i) {
        int around = (i + 4) % 9;  // the column itself first
        ivec2 column = clamp(froxel.xy + ivec2(around % 3, around / 3) - 1, ivec2(0), size.xy - 1);
        count_work(WORK_TEXTURE_FETCHES, 1u);
        if (begin <= texelFetch(farthest_view_depth, column, 0).r) return true;
    }
    return false;
}

void main() {
    ivec3 size = imageSize(froxel_scattering);
    uint words = (volumetrics.local_media_count + 31u) / 32u;
    uint group = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
    if (group >= tile_count) return;
    uint first = group * (1u + words);
    uvec3 tile = (uvec3(media_tiles[first]) >> uvec3(0u, 10u, 20u)) & 1023u;
    ivec3 froxel = ivec3(tile * gl_WorkGroupSize + gl_LocalInvocationID);
    if (any(greaterThanEqual(froxel, size))) return;
    if (!is_seen(froxel, size)) {
        flush_work();
        return;
    }

    Ray ray = view_ray((vec2(froxel.xy) + 0.5) / vec2(size.xy));
    float begin = froxel_slice_begin(froxel.z, size.z) / ray.forward_cosine;
    float end = froxel_slice_begin(froxel.z + 1, size.z) / ray.forward_cosine;

    vec4 scattering = vec4(0.0);
    vec3 extinction = vec3(0.0);
    vec3 emission = vec3(0.0);
    for (uint word = 0u; word < words; ++word) {
        for (uint bits = media_tiles[first + 1u + word]; bits != 0u; bits &= bits - 1u) {
            LocalMedium medium = local_media[32u * word + uint(findLSB(bits))];
            vec2 part = inside_shape(medium, ray.origin, ray.direction, begin, end);
            if (part.x >= part.y) continue;
            count_work(WORK_MEDIUM_SAMPLES, 1u);
            float density = (part.y - part.x) / (end - begin) *
                            mean_density(medium, ray.origin, ray.direction, part.x, part.y) *
                            mean_noise(medium, ray.origin, ray.direction, part.x, part.y, MOST_SAMPLES) *
                            mean_grid(medium, ray.origin, ray.direction, part.x, part.y,
                                      width_at(ray, 0.5 * (part.x + part.y), float(size.x)), MOST_SAMPLES);
            vec3 sigma_s = medium.sigma_s_g.rgb * density;
            scattering += vec4(sigma_s, medium.sigma_s_g.w * dot(sigma_s, vec3(1.0 / 3.0)));
            extinction += sigma_s + medium.sigma_a_shape.rgb * density;
            emission += medium.emission_noise.rgb * density;
        }
    }
    // What is denser than a half float holds is opaque all the same: as long as its coefficients keep their ratios.
    const float LARGEST = 1.0e30;
    float densest = min(max(extinction.r, max(extinction.g, extinction.b)), LARGEST);
    float scale = min(HALF_MAX / max(densest, 1.0), 1.0);
    imageStore(froxel_scattering, froxel, round_to_half(min(scattering, LARGEST) * scale));
    imageStore(froxel_extinction, froxel, round_to_half(vec4(min(extinction, LARGEST) * scale, 0.0)));
#if EMISSION
    imageStore(froxel_emission, froxel, round_to_half(vec4(min(emission, LARGEST) * scale, 0.0)));
#endif
    flush_work();
}
