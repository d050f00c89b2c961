// First step of a light volume: adds the optical depth of a local medium in each slab between two texels along a light's ray.
// Texel k = 0 is where the rays begin and holds 0. light_volume_sum.comp adds the slabs up.
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/light/light_volume.glsl"
#include "shaders/volumetrics/media/local_media.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 4) in;

#if CHROMATIC
layout(rgba16f, binding = 0) uniform image3D volume;
#else
layout(r16f, binding = 0) uniform image3D volume;
#endif

uniform ivec3 origin;  // of the light's part of the volume, texels
uniform ivec3 size;
uniform uint medium_index;
uniform ivec3 first_texel;  // that the medium may reach
uniform ivec3 end_texel;
#if LAMP
uniform vec3 lamp_position;
uniform vec4 lamp_window;  // see light_volume.glsl
uniform vec2 lamp_span;  // m from the lamp: first and last texel
#else
uniform mat4 volume_to_world;  // from texture coordinates
#endif

// Samples of a medium in a slab, unless its density is constant.
const int SAMPLES = 2;
const int MOST_GRID_SAMPLES = 4;

// sigma_t int density dt over the segment, `across` metres wide, in closed form where density is constant.
vec3 slab_optical_depth(vec3 from, vec3 direction, float path_length, float across) {
    LocalMedium medium = local_media[medium_index];
    vec2 inside = inside_shape(medium, from, direction, 0.0, path_length);
    if (inside.x >= inside.y) return vec3(0.0);
    float density = 1.0;
    if (has_grid(medium)) {
        density = mean_grid(medium, from, direction, inside.x, inside.y, across, MOST_GRID_SAMPLES);
    } else if (!is_homogeneous(medium)) {
        count_work(WORK_MEDIUM_SAMPLES, uint(SAMPLES));
        density = 0.0;
        for (int k = 0; k < SAMPLES; ++k) {
            float t = mix(inside.x, inside.y, (float(k) + 0.5) / float(SAMPLES));
            density += local_density(medium, from + direction * t) / float(SAMPLES);
        }
    }
    return local_sigma_t(medium) * (density * (inside.y - inside.x));
}

void main() {
    ivec3 texel = first_texel + ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, end_texel))) return;
    if (texel.z > 0) {
#if LAMP
        // One texel of border all round.
        vec3 direction = lamp_tile_direction((vec2(texel.xy) - 0.5) / vec2(size.xy - 2), lamp_window);
        float path_length = (lamp_span.y - lamp_span.x) / float(size.z - 1);
        float across = 2.0 * (lamp_span.x + path_length * (float(texel.z) - 0.5)) / float(size.x - 2) *
                       (lamp_window.w > 0.0 ? 1.0 / lamp_window.w : 1.5);
        vec3 from = lamp_position + direction * (lamp_span.x + path_length * float(texel.z - 1));
#else
        vec3 uvw = (vec3(texel) + vec3(0.5, 0.5, -0.5)) / vec3(size);
        vec3 from = (volume_to_world * vec4(uvw, 1.0)).xyz;
        vec3 along = volume_to_world[2].xyz / float(size.z);
        float path_length = length(along);
        vec3 direction = along / path_length;
        float across = length(volume_to_world[0].xyz) / float(size.x);
#endif
        vec3 depth = slab_optical_depth(from, direction, path_length, across);
        if (any(greaterThan(depth, vec3(0.0))))
            imageStore(volume, origin + texel,
                       round_to_half(vec4(min(imageLoad(volume, origin + texel).rgb + depth, vec3(HALF_MAX)), 1.0)));
    }
    flush_work();
}
