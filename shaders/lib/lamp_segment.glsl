#ifndef TYNDALL_LIB_LAMP_SEGMENT
#define TYNDALL_LIB_LAMP_SEGMENT

// Light of a point or spot lamp, at a point and over a segment of a ray. Lengths in metres; attenuations in 1/m^2,
// to be multiplied by the intensity [cd]. Every function holds the same law (KHR_lights_punctual, with the lamp's
// radius):
//     attenuation(d) = (1 - (d / range)^4) / max(d^2, radius^2) for d < range, else 0.
// A range is passed as its inverse, 0 for a lamp without one.

// Smaller radii are taken as this: 1/d^2 has no finite integral through a point.
const float LAMP_MIN_RADIUS = 1.0e-3f;

float lamp_attenuation(float distance_squared, float radius, float inverse_range) {
    float s = distance_squared * inverse_range * inverse_range;
    float r = max(radius, LAMP_MIN_RADIUS);
    return clamp(1.0f - s * s, 0.0f, 1.0f) / max(distance_squared, r * r);
}

// KHR_lights_punctual's cone: x scale, y offset for spot_cone, from the cosines of the inner and outer half angles. Its
// floor of 0.001 under their difference would dim any cone of less than 2.6 degrees: here it is that share of the
// largest difference that the outer angle allows.
vec2 spot_scale_offset(float cos_inner, float cos_outer) {
    float scale = 1.0f / max(0.001f * max(1.0f - cos_outer, 1.0e-7f), cos_inner - cos_outer);
    return vec2(scale, -cos_outer * scale);
}

// cos_angle is between the spot's axis and the direction from the spot to the point.
float spot_cone(float cos_angle, vec2 scale_offset) {
    float s = clamp(cos_angle * scale_offset.x + scale_offset.y, 0.0f, 1.0f);
    return s * s;
}

// A lamp as seen from a ray: d(t)^2 = h^2 + (t - t_closest)^2.
struct LampRay {
    float t_closest;  // ray parameter of the point nearest to the lamp; any sign
    float h;          // distance of that point from the lamp, >= 0
};

LampRay lamp_ray(vec3 origin, vec3 unit_direction, vec3 lamp_position) {
    vec3 to_lamp = lamp_position - origin;
    LampRay ray;
    ray.t_closest = dot(to_lamp, unit_direction);
    ray.h = length(to_lamp - unit_direction * ray.t_closest);
    return ray;
}

// int_a^b du / (h^2 + u^2) where h and [a, b] do not both touch 0, and span = b - a >= 0. It is
// (atan(b/h) - atan(a/h)) / h, by one atan of the difference, which does not cancel; for a small angle the series
// of atan, which holds to h = 0, where the integral is (b - a) / (a b).
float inverse_square_integral(float a, float b, float span, float h) {
    float product = h * h + a * b;
    float z = h * span;
    if (z < 0.2f * product) {
        float z2 = z * z / (product * product);
        return span / product * (1.0f - z2 * (1.0f / 3.0f - z2 * (1.0f / 5.0f - z2 * (1.0f / 7.0f))));
    }
    return atan(z, product) / h;
}

// The inverse: how far u advances from a until the integral of 1 / (h^2 + u^2) reaches a value. The angle swept as
// seen from the lamp is y = h integral, and u - a = sin(y) (h^2 + a^2) / (h cos(y) - a sin(y)); it holds to h = 0.
float inverse_square_advance(float a, float h, float integral) {
    float y = h * integral;
    float y2 = y * y;
    float s = y < 0.2f ? integral * (1.0f - y2 * (1.0f / 6.0f - y2 * (1.0f / 120.0f))) : sin(y) / h;
    return s * (h * h + a * a) / max(cos(y) - a * s, 1.0e-20f);
}

// int 1 / max(d^2, radius^2) du from u = a to u = b along a ray at distance h from the lamp, in three parts: before the
// sphere of the radius, in it (from enter to leave), and behind it. All counts as before where the sphere is not met.
struct LampIntegral {
    float a;
    float h;
    float enter;
    float leave;
    float before;
    float inside;
    float total;
};

LampIntegral lamp_integral(float a, float b, float span, float h, float radius) {
    LampIntegral parts;
    parts.a = a;
    parts.h = h;
    parts.enter = b;
    parts.leave = b;
    float sphere = max(radius, LAMP_MIN_RADIUS);
    float chord = sqrt(max(sphere * sphere - h * h, 0.0f));
    if (h < sphere && a < chord && b > -chord) {
        parts.enter = max(a, -chord);
        parts.leave = min(b, chord);
        span = parts.enter - a;
    }
    parts.before = span > 0.0f ? inverse_square_integral(a, parts.enter, span, h) : 0.0f;
    parts.inside = (parts.leave - parts.enter) / (sphere * sphere);
    float behind = parts.leave < b ? inverse_square_integral(parts.leave, b, b - parts.leave, h) : 0.0f;
    parts.total = parts.before + parts.inside + behind;
    return parts;
}

// u - a at which the integral from a reaches a value.
float lamp_advance(LampIntegral parts, float integral) {
    float rest = integral - parts.before;
    if (rest > 0.0f && rest <= parts.inside) {
        return parts.enter - parts.a + (parts.leave - parts.enter) * rest / parts.inside;
    }
    bool behind = rest > parts.inside;
    float from = behind ? parts.leave : parts.a;
    return from - parts.a + inverse_square_advance(from, parts.h, behind ? rest - parts.inside : integral);
}

// Quadrature rule int_{t_begin}^{t_end} attenuation(d(t)) f(t) dt = sum_i weight_i f(t_i) for what else varies
// along the segment: phase, transmittance, cone, visibility. The nodes are Gauss-Legendre in the integral of the
// clamped inverse square, which outside the lamp's sphere is the angle seen from the lamp (equi-angular, Kulla and
// Fajardo 2012), the variable in which phase and cone are smooth. The sum of the weights is the closed form of the
// integral of the attenuation. t rises from x to w inside the segment; weights [1/m] are >= 0, all 0 where nothing
// arrives.
struct LampSegment {
    vec4 t;
    vec4 weight;
    LampIntegral inverse_square;  // over what is in range
};

// Error of the rule against quadrature, relative to the integral, root mean square (maximum), over segments of 0.05
// to 50 m that pass a lamp at 0.02 to 20 m; "mean" is the integral times f at the mean of t by weight, "centre" one
// sample of everything at the middle of the segment:
//     f                                           rule           mean           centre
//     transmittance, sigma_t length <= 0.3        0.04% (0.3%)   0.13% (0.4%)   230%
//     transmittance, sigma_t length <= 1          0.16% (1.3%)   1.4% (4.1%)    230%
//     transmittance, sigma_t length <= 3          1.1% (11%)     11% (31%)      230%
//     that to 0.5, Henyey-Greenstein g = 0.3      0.17% (1.1%)   16% (45%)      210%
//     that to 0.5, Henyey-Greenstein g = 0.6      1.4% (4.6%)    38% (80%)      150%
//     that to 0.5, Henyey-Greenstein g = 0.85     12% (32%)      52% (97%)      120%
//
// The integral of the range window is exact outside the sphere of the lamp's radius and within
// (radius / range)^4 / 4 of the law inside it.
LampSegment lamp_segment(LampRay ray, float t_begin, float t_end, float radius, float inverse_range) {
    LampSegment segment;
    segment.t = vec4(t_begin);
    segment.weight = vec4(0.0f);
    segment.inverse_square = LampIntegral(0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
    float h = ray.h;
    float a = t_begin - ray.t_closest;
    float b = t_end - ray.t_closest;
    float span = t_end - t_begin;  // not b - a, which would lose the digits of a short segment
    float first = t_begin;
    float inverse_range_squared = inverse_range * inverse_range;
    if (inverse_range > 0.0f) {
        float reach = sqrt(max(1.0f / inverse_range_squared - h * h, 0.0f));
        if (a < -reach || b > reach) {
            first += max(-reach - a, 0.0f);
            a = max(a, -reach);
            b = min(b, reach);
            span = b - a;
        }
    }
    if (span <= 0.0f) {
        return segment;
    }

    LampIntegral parts = lamp_integral(a, b, span, h, radius);
    segment.inverse_square = parts;
    float total = parts.total;
    vec4 target = total * vec4(0.06943184f, 0.33000948f, 0.66999052f, 0.93056816f);
    vec4 advance = vec4(lamp_advance(parts, target.x), lamp_advance(parts, target.y), lamp_advance(parts, target.z),
                        lamp_advance(parts, target.w));
    advance = clamp(advance, vec4(0.0f), vec4(span));
    segment.t = clamp(first + advance, vec4(t_begin), vec4(t_end));

    vec4 u = a + advance;
    vec4 s = (h * h + u * u) * inverse_range_squared;
    segment.weight =
        total * vec4(0.17392742f, 0.32607258f, 0.32607258f, 0.17392742f) * max(1.0f - s * s, vec4(0.0f));
    // int d^2 / range^4: the window takes this from the integral of the inverse square.
    float m = 0.5f * (a + b);
    float cut = span * (h * h + m * m + span * span / 12.0f) * inverse_range_squared * inverse_range_squared;
    segment.weight *= max(total - cut, 0.0f) / max(dot(segment.weight, vec4(1.0f)), 1.0e-30f);
    return segment;
}

// Where a share of the light has been gathered, as a share of the inverse square, both 0..1: each node's part of the light
// (weight_i f(t_i) >= 0) is taken to be spread like the inverse square over its own piece of it, as wide as its weight
// there. So points at even shares lie as densely as there is light, and one visibility for all of it is not biased.
// Without light: the share itself.
float lamp_segment_place(vec4 parts, float share) {
    vec4 sums = vec4(parts.x, parts.x + parts.y, parts.x + parts.y + parts.z, dot(parts, vec4(1.0f)));
    if (!(sums.w > 1.0e-30f && sums.w < 1.0e30f)) return share;
    float target = share * sums.w;
    vec3 done = vec3(target > sums.x ? 1.0f : 0.0f, target > sums.y ? 1.0f : 0.0f, target > sums.z ? 1.0f : 0.0f);
    float begin = dot(done, vec3(0.17392742f, 0.32607258f, 0.32607258f));
    float width = done.x == done.z ? 0.17392742f : 0.32607258f;
    float part = done.z > 0.0f ? parts.w : done.y > 0.0f ? parts.z : done.x > 0.0f ? parts.y : parts.x;
    float before = dot(done, vec3(parts.x, parts.y, parts.z));
    return clamp(begin + width * (target - before) / max(part, 1.0e-30f), 0.0f, 1.0f);
}

// The share of the light that is gathered before a share of the inverse square, both 0..1: the integral of the cubic through the
// nodes, as sum_k m_k (P_{k+1}(x) - P_{k-1}(x)) / 2 of Legendre polynomials over x = -1..1, with the moments m_k = sum_i parts_i P_k(x_i)
// and x + 1 for the difference where k = 0. In an optical depth of 1 it is 0.4% of the whole off for g = 0.3 and 1.5% for g = 0.6, root mean
// square. Without light: the share itself.
float lamp_segment_share(vec4 parts, float share) {
    float sum = dot(parts, vec4(1.0f));
    if (!(sum > 1.0e-30f && sum < 1.0e30f)) return share;
    float m1 = dot(parts, vec4(-0.86113631f, -0.33998104f, 0.33998104f, 0.86113631f));
    float m2 = dot(parts, vec4(0.61233364f, -0.32661934f, -0.32661934f, 0.61233364f));
    float m3 = dot(parts, vec4(-0.30474702f, 0.41172800f, -0.41172800f, 0.30474702f));
    float x = 2.0f * share - 1.0f;
    float x2 = x * x;
    float p2 = 1.5f * x2 - 0.5f;
    float p3 = (2.5f * x2 - 1.5f) * x;
    float p4 = (4.375f * x2 - 3.75f) * x2 + 0.375f;
    float before = share * sum + 0.5f * (m1 * (p2 - 1.0f) + m2 * (p3 - x) + m3 * (p4 - p2));
    return clamp(before / sum, 0.0f, 1.0f);
}

// int attenuation dt over the segment [1/m].
float lamp_segment_integral(LampSegment segment) {
    return dot(segment.weight, vec4(1.0f));
}

// A spot's cone seen from a ray: with u = h tan(phi) the cosine between its axis and the direction to a point of the ray
// is along cos(phi) + across sin(phi), where `along` is the cosine to the point nearest to the lamp and `across` that to
// the ray's direction.
float cone_at_angle(float along, float across, float phi, vec2 scale_offset) {
    return spot_cone(along * cos(phi) + across * sin(phi), scale_offset);
}

// int spot_cone dphi by three nodes of Gauss-Legendre: for intervals without the kink of the clamp at 1.
float cone_over_angle(float along, float across, float begin, float end, vec2 scale_offset) {
    float middle = 0.5f * (begin + end);
    float offset = 0.38729833f * (end - begin);
    return (end - begin) / 18.0f *
           (5.0f * cone_at_angle(along, across, middle - offset, scale_offset) +
            8.0f * cone_at_angle(along, across, middle, scale_offset) +
            5.0f * cone_at_angle(along, across, middle + offset, scale_offset));
}

// What the four nodes of lamp_segment make of a spot's cone is to be multiplied by this: their sum is up to a half off
// where a kink of the cone's law lies between them, and as near to the lamp as u ~ h no segment is short enough to help.
// [t_begin, t_end] lies in the outer cone. The mean of the cone over the angle seen from the lamp, its plateau apart from
// its two flanks, over the mean at the nodes; 1 where all of the segment is on the plateau, or meets the lamp's sphere.
float lamp_segment_cone_correction(LampSegment segment, LampRay ray, float t_begin, float t_end, float radius,
                                   float along, float across, vec2 scale_offset) {
    float h = ray.h;
    if (h <= max(radius, LAMP_MIN_RADIUS)) {
        return 1.0f;
    }
    vec4 u = segment.t - ray.t_closest;
    vec4 d = sqrt(h * h + u * u);
    vec4 cos_axis = (along * h + across * u) / d;
    // Weights of the angle alone: those of the segment hold the range window, too.
    float at_nodes = 0.17392742f * (spot_cone(cos_axis.x, scale_offset) + spot_cone(cos_axis.w, scale_offset)) +
                     0.32607258f * (spot_cone(cos_axis.y, scale_offset) + spot_cone(cos_axis.z, scale_offset));
    float begin = atan(t_begin - ray.t_closest, h);
    float end = atan(t_end - ray.t_closest, h);
    // On the plateau |phi - peak| <= half_width.
    float peak = atan(across, along);
    float most = sqrt(along * along + across * across);
    float half_width = acos(clamp((1.0f - scale_offset.y) / max(scale_offset.x * most, 1.0e-20f), -1.0f, 1.0f));
    float enter = clamp(peak - half_width, begin, end);
    float leave = clamp(peak + half_width, begin, end);
    float mean = (cone_over_angle(along, across, begin, enter, scale_offset) + (leave - enter) +
                  cone_over_angle(along, across, leave, end, scale_offset)) /
                 max(end - begin, 1.0e-20f);
    return at_nodes > 1.0e-6f && end - begin > 1.0e-5f ? mean / at_nodes : 1.0f;
}

// cos_theta of the phase function at the nodes: light travels from the lamp to the node, leaves against the ray.
vec4 lamp_segment_cos_theta(LampSegment segment, LampRay ray) {
    vec4 u = segment.t - ray.t_closest;
    return -u / sqrt(max(ray.h * ray.h + u * u, vec4(1.0e-20f)));
}

#endif
