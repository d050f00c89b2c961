// In-scattering of local lights. LAMPS 1: at the sample point (the usual way). LAMPS 2: over the whole segment, with the
// inverse square in closed form, one visibility, and a four-node rule for all else.
#ifndef VOLUMETRICS_LAMPS_GLSL
#define VOLUMETRICS_LAMPS_GLSL

#include "shaders/interface/lights.glsl"
#include "shaders/interface/shadows.glsl"
#include "shaders/lib/lamp_segment.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/media/extinction.glsl"
#include "shaders/volumetrics/light/light_transmittance.glsl"
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/media/scattering.glsl"
#include "shaders/volumetrics/light/visibility.glsl"

// Rounds of all loops of the shader for each lamp that reaches all that it lights: see expect_lamps. Where a driver would end
// the loops early, every nth lamp of a list is taken, n times as bright, beginning at another for another `place`.
uint lamp_rounds = 0u;

// Lamps will be taken from the lists between two distances, and light so many segments: a walk finds a lamp in each of
// them, and reads each list once. Lanes that run in step wait for each other, so that it may take twice as long.
void expect_lamps(Ray ray, float begin, float end, uint segments) {
    uint lists = uint(light_slice(end * ray.forward_cosine) - light_slice(begin * ray.forward_cosine) + 1);
#if HEIGHT_MEDIA > 1
    uint loops = LAMPS == 1 ? 1u : 16u;  // over height media, for a lamp and segment
    uint in_media = loops * (volumetrics.height_media_count + 1u);
#else
    uint in_media = 0u;
#endif
#if EPIPOLAR
    in_media += 16u;  // nodes of a tree
    segments += 4u;   // parts of a lamp's light, see parts_a_half_turn
#endif
    lamp_rounds = LAMPS == 1 ? segments * (1u + in_media) : 2u * lists + segments * (2u + in_media);
}

uint lamp_stride(uint count) { return 1u + count * lamp_rounds / volumetrics.loop_rounds; }
// Another for each pixel, too (Roberts' R2 sequence): not all techniques have noise in `place`.
uint first_lamp(uint stride, float place, Ray ray) {
    float pixel = dot(floor(ray.uv * volumetrics.target.xy), vec2(0.7548777, 0.5698403));
    return uint(fract(39.55 * place + pixel) * float(stride));
}

// 1: of all lamps only the few of the uniform block.
#ifndef FEW_LAMPS
#define FEW_LAMPS 0
#endif
bool is_few_lamp(uint index) {
    return any(equal(volumetrics.few_lamps[0], uvec4(index))) || any(equal(volumetrics.few_lamps[1], uvec4(index)));
}
// Whether a lamp of a list is left to others.
#ifndef LEFT_OUT
#define LEFT_OUT(index) false
#endif

float lamp_inverse_range(GpuLight light) {
    return light.position_range.w > 0.0 ? 1.0 / light.position_range.w : 0.0;
}

bool is_spot(GpuLight light) { return int(light.direction_type.w) == LIGHT_SPOT; }

// A segment of the ray, and its medium apart from the height media.
struct Segment {
    float begin;  // distances along the ray, m
    float end;
    float offset;  // 0..1, where visibility is sampled: the share of the light gathered before it
    float anisotropy;
    vec3 sigma_s;
    vec3 sigma_t;
};

#if LAMPS == 1
// What a medium at a point scatters of the light of all lamps, per metre, if their visibility is that at the distance
// t_visibility; `unshadowed`: if all are visible.
vec3 lamps_at(Ray ray, float t, float t_visibility, Medium m, out vec3 unshadowed) {
    unshadowed = vec3(0.0);
    vec3 point = ray.origin + ray.direction * t;
    ClusterRange range = lights_near(ray.uv, t * ray.forward_cosine);
    vec3 sum = vec3(0.0);
    uint stride = lamp_stride(range.count);
    for (uint i = first_lamp(stride, t_visibility, ray); i < range.count; i += stride) {
        uint index = light_index(range.offset + i);
        if (LEFT_OUT(index)) continue;
        GpuLight light = light_at(index);
        count_work(WORK_LIGHT_EVALUATIONS, 1u);
        vec3 to_lamp = light.position_range.xyz - point;
        float distance_squared = dot(to_lamp, to_lamp);
        float attenuation =
            lamp_attenuation(distance_squared, LAMP_RADIUS(light), lamp_inverse_range(light));
        float distance = sqrt(distance_squared);
        to_lamp /= max(distance, 1.0e-6);
        if (is_spot(light)) attenuation *= spot_cone(-dot(to_lamp, light.direction_type.xyz), light.cone_shadow.xy);
        if (attenuation <= 0.0) continue;
        Visibility visible = lamp_visibility(index, light, visibility_point(ray, t_visibility));
        if (FROXEL_HISTORY == 0 && is_dark(visible)) continue;
        vec3 scattered = light.intensity_radius.rgb *
                         exp(-to_extinction(lamp_optical_depth(point.y, to_lamp, distance) +
                                                                  local_lamp_optical_depth(index, -to_lamp, distance))) *
                         volume_scattering(m, dot(to_lamp, ray.direction));
        sum += scattered * (visible * attenuation);
        unshadowed += scattered * attenuation;
    }
    unshadowed *= float(stride);
    return float(stride) * sum;
}
#endif

#if LAMPS == 2
// The part of a ray that lies in a spot's outer cone, in metres from the point nearest to the lamp: (A u + B) >
// cos_outer sqrt(u^2 + h^2) with A = direction . axis and B = axis . (nearest point - lamp), for an outer angle of at
// most 90 degrees. Empty: x >= y.
vec2 ray_in_cone(float A, float B, float h, float cos_outer) {
    const float FAR = 1.0e9;
    float c2 = cos_outer * cos_outer;
    float a = A * A - c2;
    float b = A * B;
    float c = B * B - c2 * h * h;
    if (abs(a) < 1.0e-5) a = a < 0.0 ? -1.0e-5 : 1.0e-5;  // parallel to the cone's side: a hair off
    float discriminant = b * b - a * c;
    if (discriminant <= 0.0) return a > 0.0 && A > 0.0 ? vec2(-B / A, FAR) : a > 0.0 ? vec2(-FAR, -B / A) : vec2(0.0);
    float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
    vec2 roots = vec2(q / a, c / (abs(q) > 1.0e-20 ? q : 1.0e-20));
    float lower = min(roots.x, roots.y);
    float upper = max(roots.x, roots.y);
    // The cone has two halves; the light is in the one where A u + B > 0.
    if (a > 0.0) return A > 0.0 ? vec2(upper, FAR) : vec2(-FAR, lower);
    return A * 0.5 * (lower + upper) + B > 0.0 ? vec2(lower, upper) : vec2(0.0);
}

// The part of the segment that a lamp reaches, and the point of that part which is nearest to the lamp.
struct Reach {
    float begin;
    float end;
    float nearest;
};

Reach lamp_reach(Ray ray, Segment segment, GpuLight light, LampRay lamp) {
    float range = light.position_range.w;
    float half_chord = range > 0.0 ? sqrt(max(range * range - lamp.h * lamp.h, 0.0)) : 1.0e9;
    vec2 lit = vec2(-half_chord, half_chord);
    if (is_spot(light)) {
        vec3 axis = light.direction_type.xyz;
        vec3 from_lamp = ray.origin + ray.direction * lamp.t_closest - light.position_range.xyz;
        vec2 cone = ray_in_cone(dot(ray.direction, axis), dot(from_lamp, axis), lamp.h,
                                -light.cone_shadow.y / light.cone_shadow.x);
        lit = vec2(max(lit.x, cone.x), min(lit.y, cone.y));
    }
    Reach reach;
    reach.begin = max(segment.begin, lamp.t_closest + lit.x);
    reach.end = min(segment.end, lamp.t_closest + lit.y);
    reach.nearest = clamp(lamp.t_closest, reach.begin, max(reach.begin, reach.end));
    return reach;
}

// A walk over the lamps of a segment. It may pass many light lists: looking up one of them would lose the lamps of the
// others. So all are read, and a lamp is found where its nearest lit point lies, which is listed if any part of the
// segment is lit: once, whatever lists repeat it.
struct LampWalk {
    float begin;  // of the slice, along the ray
    float end;
    int slice;
    uint next;  // entry of the slice's list
    uint list_end;
    uint stride;
};

struct FoundLamp {
    uint index;
    LampRay lamp;
    Reach reach;
};

LampWalk lamp_walk(Ray ray, Segment segment) {
    return LampWalk(segment.begin, segment.begin, light_slice(segment.begin * ray.forward_cosine) - 1, 0u, 0u, 1u);
}

void next_slice(Ray ray, Segment segment, inout LampWalk walk) {
    ++walk.slice;
    walk.begin = walk.end;
    walk.end = clamp(light_slice_end(walk.slice) / ray.forward_cosine, walk.begin, segment.end);
    ClusterRange range = lights_in_slice(ray.uv, walk.slice);
    walk.stride = lamp_stride(range.count);
    walk.next = range.offset + first_lamp(walk.stride, segment.offset, ray);
    walk.list_end = range.offset + range.count;
}

// Rasterisers that run all lanes in step pay what is done with a lamp only for the lamps found.
bool next_lamp(Ray ray, Segment segment, inout LampWalk walk, out FoundLamp found) {
#if FEW_LAMPS
    while (walk.next < volumetrics.few_lamp_count) {
        found.index = volumetrics.few_lamps[walk.next / 4u][walk.next % 4u];
        ++walk.next;
        GpuLight light = light_at(found.index);
        found.lamp = lamp_ray(ray.origin, ray.direction, light.position_range.xyz);
        found.reach = lamp_reach(ray, segment, light, found.lamp);
        if (found.reach.begin < found.reach.end) return true;
    }
#else
    while (walk.next < walk.list_end || walk.end < segment.end) {
        if (walk.next >= walk.list_end) {
            next_slice(ray, segment, walk);
            continue;
        }
        found.index = light_index(walk.next);
        walk.next += walk.stride;
        if (LEFT_OUT(found.index)) continue;
        GpuLight light = light_at(found.index);
        found.lamp = lamp_ray(ray.origin, ray.direction, light.position_range.xyz);
        found.reach = lamp_reach(ray, segment, light, found.lamp);
        bool here = found.reach.nearest >= walk.begin &&
                    (found.reach.nearest < walk.end || walk.end >= segment.end);
        if (here && found.reach.begin < found.reach.end) return true;
    }
#endif
    return false;
}

// What reaches the segment's front of the light a lamp sends to a point of it, apart from inverse square.
vec3 lamp_transport(Ray ray, Segment segment, uint index, GpuLight light, float t, float cos_theta) {
    vec3 point = ray.origin + ray.direction * t;
    vec3 from_lamp = point - light.position_range.xyz;
    float distance = length(from_lamp);
    from_lamp /= max(distance, 1.0e-6);
    float advance = t - segment.begin;
    vec3 depth = segment.sigma_t * advance + lamp_optical_depth(point.y, -from_lamp, distance) +
                 local_lamp_optical_depth(index, from_lamp, distance);
    Medium m;
    m.sigma_s = segment.sigma_s;
    m.anisotropy = segment.anisotropy;
    m.sigma_s_rayleigh = global_sigma_s_rayleigh(point.y);
#if HEIGHT_MEDIA
    m.sigma_s += height_sigma_s(point.y);
    depth += height_optical_depth(ray.origin.y + ray.direction.y * segment.begin, ray.direction.y, advance);
#endif
    vec3 transport = volume_scattering(m, cos_theta) * exp(-to_extinction(depth));
    if (is_spot(light)) transport *= spot_cone(dot(from_lamp, light.direction_type.xyz), light.cone_shadow.xy);
    return transport;
}

vec3 lamp_over_reach(Ray ray, Segment segment, FoundLamp found, Reach reach, inout vec3 unshadowed) {
    count_work(WORK_LIGHT_EVALUATIONS, 1u);
    GpuLight light = light_at(found.index);
    LampRay lamp = found.lamp;
    float radius = LAMP_RADIUS(light);
    LampSegment rule = lamp_segment(lamp, reach.begin, reach.end, radius, lamp_inverse_range(light));
    vec4 cos_theta = lamp_segment_cos_theta(rule, lamp);
    vec3 sum = vec3(0.0);
    vec4 parts;
    for (int i = 0; i < 4; ++i) {
        vec3 part = lamp_transport(ray, segment, found.index, light, rule.t[i], cos_theta[i]) * rule.weight[i];
        parts[i] = mean_channel(part);
        sum += part;
    }

    if (is_spot(light)) {
        vec3 axis = light.direction_type.xyz;
        vec3 from_lamp = ray.origin + ray.direction * lamp.t_closest - light.position_range.xyz;
        sum *= lamp_segment_cone_correction(rule, lamp, reach.begin, reach.end, radius,
                                            dot(from_lamp, axis) / max(lamp.h, 1.0e-6), dot(ray.direction, axis),
                                            light.cone_shadow.xy);
    }

    Visibility visible = lamp_share(ray, found.index, light, vec2(reach.begin, reach.end), rule.inverse_square, parts, segment.offset);
    unshadowed += light.intensity_radius.rgb * sum;
    return visible * light.intensity_radius.rgb * sum;
}

#if EPIPOLAR
// Into how many parts of equal angles, as seen from the lamp, its rule needs a half turn cut: for the peak of the phase function, so that what
// passes a lamp anywhere in an optical depth of up to 2 is off by at most 0.3% for g = 0.3, 0.2% for 0.6 and 0.6% for 0.9 (by quadrature); for the
// kinks of a spot's law; in the sphere of the lamp's radius, where the angle changes fast and the light does not; and for the points that ask for glass.
float parts_a_half_turn(Segment segment, GpuLight light, LampRay lamp) {
    bool two_lobes = volumetrics.phase >= uint(PHASE_DOUBLE_HENYEY_GREENSTEIN);
    float g = two_lobes ? 0.9 : min(abs(segment.anisotropy), 0.9);
    float parts = 1.0 / (1.0 - g);
    if (is_spot(light)) parts = max(parts, 4.0);
    if (lamp.h < LAMP_RADIUS(light)) parts = max(parts, 4.0 * min(1.0, 3.0 * g));
#if LAMP_GLASS
    if (light.cone_shadow.w > 0.0) parts = max(parts, 8.0);
#endif
    return parts;
}

vec3 lamp_over_segment(Ray ray, Segment segment, FoundLamp found, inout vec3 unshadowed) {
    GpuLight light = light_at(found.index);
    LampRay lamp = found.lamp;
    Reach part = found.reach;
    float a = part.begin - lamp.t_closest;
    float b = part.end - lamp.t_closest;
    float angle = atan(lamp.h * (part.end - part.begin), lamp.h * lamp.h + a * b);
    const float HALF_TURN = 3.14159265;
    int parts = int(max(parts_a_half_turn(segment, light, lamp) * angle / HALF_TURN + 0.5, 1.0));
    vec3 sum = vec3(0.0);
    for (int i = 1; i <= parts; ++i) {
        float integral = angle * float(i) / (float(parts) * max(lamp.h, 1.0e-6));
        part.end = i == parts ? found.reach.end
                              : clamp(found.reach.begin + inverse_square_advance(a, lamp.h, integral), part.begin, found.reach.end);
        sum += lamp_over_reach(ray, segment, found, part, unshadowed);
        part.begin = part.end;
    }
    return sum;
}
#else
vec3 lamp_over_segment(Ray ray, Segment segment, FoundLamp found, inout vec3 unshadowed) {
    return lamp_over_reach(ray, segment, found, found.reach, unshadowed);
}
#endif

// Radiance that all lamps scatter to the segment's front; `unshadowed`: what it would be without shadows.
vec3 lamps_over_segment(Ray ray, Segment segment, out vec3 unshadowed) {
    vec3 sum = vec3(0.0);
    unshadowed = vec3(0.0);
    LampWalk walk = lamp_walk(ray, segment);
    FoundLamp found;
    while (next_lamp(ray, segment, walk, found)) {
        vec3 whole = vec3(0.0);
        sum += float(walk.stride) * lamp_over_segment(ray, segment, found, whole);
        unshadowed += float(walk.stride) * whole;
    }
    return sum;
}
#endif

#endif
