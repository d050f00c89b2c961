#ifndef TYNDALL_LIB_LAMP_SEGMENT
#define TYNDALL_LIB_LAMP_SEGMENT

// Light of a point or spot lamp, at a point and over a segment of a ray. Lengths in metres; attenuations in 1/m^2, to
// be multiplied by the intensity [cd]. Every function holds the same law (KHR_lights_punctual, with the lamp's radius):
//     attenuation(d) = (1 - (d / range)^4) / max(d^2, radius^2) for d < range, else 0.
// A range is passed as its inverse, 0 for a lamp without one.

// Smaller radii are taken as this: 1/d^2 has no finite integral through a point.
const float LAMP_MIN_RADIUS = 1.0e-3f;

float lamp_attenuation(float distance_squared, float radius, float inverse_range) {
    float s = distance_squared * inverse_range * inverse_range;
    float r = max(radius, LAMP_MIN_RADIUS);
    return clamp(1.0f - s * s, 0.0f, 1.0f) / max(distance_squared, r * r);
}

// KHR_lights_punctual's cone: x scale, y offset for spot_cone, from the cosines of the inner and outer half angles.
vec2 spot_scale_offset(float cos_inner, float cos_outer) {
    float scale = 1.0f / max(0.001f, cos_inner - cos_outer);
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
// (atan(b/h) - atan(a/h)) / h, by one atan of the difference, which does not cancel; for a small angle the series of
// atan, which holds to h = 0, where the integral is (b - a) / (a b).
float inverse_square_integral(float a, float b, float span, float h) {
    float product = h * h + a * b;
    float z = h * span;
    if (z < 0.2f * product) {
        float z2 = z * z / (product * product);
        return span / product * (1.0f - z2 * (1.0f / 3.0f - z2 * (1.0f / 5.0f - z2 * (1.0f / 7.0f))));
    }
    return atan(z, product) / h;
}

// Moments int v^n w dv, n = 0..3 in xyzw, of a weight over a part of the segment. u runs from the point nearest to the
// lamp, v = u - m from the segment's middle m, so that d^2 = h^2 + u^2 = q + 2 m v + v^2 with q = h^2 + m^2.

// w = 1 / d^2 on u in [a, b], span = b - a. As v^2 / d^2 = 1 - (q + 2 m v) / d^2, each moment follows from two others.
vec4 moments_inverse_square(float a, float b, float span, float m, float h) {
    float q = h * h + m * m;
    float e0 = inverse_square_integral(a, b, span, h);
    float e1 = 0.5f * log((h * h + b * b) / (h * h + a * a)) - m * e0;
    float e2 = span - q * e0 - 2.0f * m * e1;
    float e3 = span * (0.5f * (a + b) - m) - q * e1 - 2.0f * m * e2;
    return vec4(e0, e1, e2, e3);
}

// w = 1 / d^2 on v in [-r, r] where r^2 is small against q and the above would cancel. With k = m / sqrt(q) and
// e = r / sqrt(q) the weight is the generating function of the Chebyshev polynomials, 1/q sum_n U_n(-k) (e v / r)^n.
vec4 moments_inverse_square_far(float r, float m, float h) {
    float q = h * h + m * m;
    float k2 = m * m / q;
    float e2 = r * r / q;
    float u1 = -2.0f * m * r / q;  // U_1 e
    float u2 = (4.0f * k2 - 1.0f) * e2;
    float u3 = u1 * (4.0f * k2 - 2.0f) * e2;
    float u4 = ((16.0f * k2 - 12.0f) * k2 + 1.0f) * e2 * e2;
    vec4 unit = vec4(1.0f + u2 / 3.0f + u4 / 5.0f, u1 / 3.0f + u3 / 5.0f, 1.0f / 3.0f + u2 / 5.0f + u4 / 7.0f,
                     u1 / 5.0f + u3 / 7.0f);
    return 2.0f * r / q * unit * vec4(1.0f, r, r * r, r * r * r);
}

// w = 1 on a span of v about the middle c.
vec4 moments_constant(float c, float span) {
    float s2 = span * span;
    return span * vec4(1.0f, c, c * c + s2 / 12.0f, c * (c * c + 0.25f * s2));
}

// w = d^2 on v in [-r, r].
vec4 moments_square(float r, float m, float h) {
    float r2 = r * r;
    float q = h * h + m * m;
    return 2.0f * r * vec4(q + r2 / 3.0f, 2.0f * m * r2 / 3.0f, q * r2 / 3.0f + r2 * r2 / 5.0f, 2.0f * m * r2 * r2 / 5.0f);
}

// Two-point Gauss rule for int_{t_begin}^{t_end} attenuation(d(t)) f(t) dt = weight0 f(t0) + weight1 f(t1): the
// attenuation is the weight function of the rule and is integrated in closed form, f is what else varies
// (transmittance, phase, cone, visibility). Exact for f up to the third power of t, so the sum of the weights is
// the integral of the attenuation alone. t0 <= t1 lie inside the segment, weights are >= 0 [1/m].
struct LampSegment {
    float t0;
    float t1;
    float weight0;
    float weight1;
};

// Inside the sphere of the lamp's radius the range window is 1 - (d / range)^4 (radius / d)^2 here, which differs from
// the law by at most (radius / range)^4 / 4.
LampSegment lamp_segment(LampRay ray, float t_begin, float t_end, float radius, float inverse_range) {
    float h = ray.h;
    float a = t_begin - ray.t_closest;
    float b = t_end - ray.t_closest;
    float span = t_end - t_begin;  // not b - a, which would lose the digits of a short segment
    float inverse_range_squared = inverse_range * inverse_range;
    LampSegment segment;
    segment.t0 = t_begin;
    segment.t1 = t_begin;
    segment.weight0 = 0.0f;
    segment.weight1 = 0.0f;
    if (inverse_range > 0.0f) {
        float reach = sqrt(max(1.0f / inverse_range_squared - h * h, 0.0f));
        if (a < -reach || b > reach) {
            a = max(a, -reach);
            b = min(b, reach);
            span = b - a;
        }
    }
    if (span <= 0.0f) {
        return segment;
    }
    float r = 0.5f * span;
    float m = 0.5f * (a + b);

    float sphere = max(radius, LAMP_MIN_RADIUS);
    float chord = sqrt(max(sphere * sphere - h * h, 0.0f));
    vec4 e = vec4(0.0f);
    if (h < sphere && a < chord && b > -chord) {
        float enter = max(a, -chord);
        float leave = min(b, chord);
        e = moments_constant(0.5f * (enter + leave) - m, leave - enter) / (sphere * sphere);
        if (a < -chord) {
            e += moments_inverse_square(a, -chord, -chord - a, m, h);
        }
        if (b > chord) {
            e += moments_inverse_square(chord, b, b - chord, m, h);
        }
    } else if (r * r < 0.01f * (h * h + m * m)) {
        e = moments_inverse_square_far(r, m, h);
    } else {
        e = moments_inverse_square(a, b, span, m, h);
    }
    e -= inverse_range_squared * inverse_range_squared * moments_square(r, m, h);
    if (e.x <= 0.0f) {
        return segment;
    }

    // Mean, variance and skewness of the attenuation give the nodes and weights of the rule.
    float mean = e.y / (e.x * r);
    float raw2 = e.z / (e.x * r * r);
    float raw3 = e.w / (e.x * r * r * r);
    float variance = clamp(raw2 - mean * mean, 1.0e-6f, 1.0f);
    float deviation = sqrt(variance);
    float half_skew = 0.5f * (raw3 - 3.0f * mean * raw2 + 2.0f * mean * mean * mean) / (variance * deviation);
    float root = sqrt(1.0f + half_skew * half_skew);
    float near_share = 0.5f * (1.0f + half_skew / root);
    float middle = m + ray.t_closest;
    segment.t0 = clamp(middle + r * (mean + deviation * (half_skew - root)), t_begin, t_end);
    segment.t1 = clamp(middle + r * (mean + deviation * (half_skew + root)), t_begin, t_end);
    segment.weight0 = e.x * near_share;
    segment.weight1 = e.x * (1.0f - near_share);
    return segment;
}

// int attenuation dt over the segment [1/m].
float lamp_segment_integral(LampSegment segment) {
    return segment.weight0 + segment.weight1;
}

// The attenuation-weighted mean of t over the segment: the representative point of a single sample.
float lamp_segment_mean(LampSegment segment) {
    return (segment.weight0 * segment.t0 + segment.weight1 * segment.t1) /
           max(lamp_segment_integral(segment), 1.0e-30f);
}

// int attenuation(d(t)) exp(-sigma_t (t - t_begin)) dt [1/m], for a constant extinction sigma_t [1/m] in the segment.
// Relative error over random segments (h 0.02..20 m, length 0.05..50 m), root mean square and maximum:
// 0.00% and 0.00% for sigma_t length <= 0.3, 0.01% and 0.05% to 1, 0.4% and 1.7% to 3.
vec3 lamp_segment_transmitted(LampSegment segment, vec3 sigma_t, float t_begin) {
    return segment.weight0 * exp(-sigma_t * (segment.t0 - t_begin)) +
           segment.weight1 * exp(-sigma_t * (segment.t1 - t_begin));
}

#endif
