#ifndef TYNDALL_LIB_TRANSMITTANCE
#define TYNDALL_LIB_TRANSMITTANCE

// Beer-Lambert in closed form. sigma_t [1/m] is the extinction at density 1, lengths are metres, an optical
// depth is sigma_t times the integral of the density and has no unit; transmittance = exp(-optical depth).

vec3 transmittance_homogeneous(vec3 sigma_t, float path_length) {
    return exp(-sigma_t * path_length);
}

// What a segment does to light, see integrate_segment.
struct MediumSegment {
    vec3 transmittance;     // from its far end to its near end
    vec3 effective_length;  // m, the integral over the segment of the transmittance to its near end
};

// Energy-conserving integral over a segment with constant extinction (Hillaire 2015):
//     effective_length = int_0^d exp(-sigma_t t) dt = (1 - exp(-sigma_t d)) / sigma_t,    optical_depth = sigma_t
//     d,
// so a constant source S [radiance per metre] adds S * effective_length. It tends to d as sigma_t -> 0 and to
// 1 / sigma_t as d grows. For x = sigma_t d < 1 the difference would cancel: there
//     (1 - exp(-x)) / x = exp(-x/2) sinh(x/2) / (x/2)
// with the series of sinh, whose first neglected term is below 1.1e-8.
// The optical depth may be that of a varying medium: then sigma_t is its mean over the segment, and the result is
// exact for a source that is proportional to the extinction.
MediumSegment integrate_segment(vec3 optical_depth, float path_length) {
    vec3 half_depth = 0.5f * optical_depth;
    vec3 half_transmittance = exp(-half_depth);
    vec3 y = min(half_depth, 0.5f);
    vec3 y2 = y * y;
    vec3 thin = half_transmittance * (1.0f + y2 * (1.0f / 6.0f + y2 * (1.0f / 120.0f + y2 * (1.0f / 5040.0f))));
    MediumSegment segment;
    segment.transmittance = half_transmittance * half_transmittance;
    vec3 thick = (1.0f - segment.transmittance) / max(optical_depth, 0.5f);
    segment.effective_length = path_length * mix(thin, thick, step(1.0f, optical_depth));
    return segment;
}

// The same quotient (1 - exp(-x)) / x of one number x >= 0: the mean of exp(-s) over 0 <= s <= x.
float mean_exponential(float x) {
    if (x < 1.0f) {
        float y2 = 0.25f * x * x;
        return exp(-0.5f * x) * (1.0f + y2 * (1.0f / 6.0f + y2 * (1.0f / 120.0f + y2 * (1.0f / 5040.0f))));
    }
    return (1.0f - exp(-x)) / x;
}

// --- Exponential height medium: density(y) = exp(-(y - base) / falloff), falloff > 0, not clamped below base.

// The exponent is held at this value (density 2.4e17), so that with any sigma_t up to 1e3 the optical depth of 1e9 m stays
// below 1e30: where that is cut off, light would no longer be in proportion to it.
const float HEIGHT_MAX_EXPONENT = 40.0f;

// Stands for an infinite density length [m]: any sigma_t above 1e-28 makes the transmittance 0, and sigma_t = 0
// gives 1.
const float HEIGHT_INFINITE_LENGTH = 1.0e30f;

float height_density(float y, float base, float falloff) {
    return exp(min((base - y) / falloff, HEIGHT_MAX_EXPONENT));
}

// Mean density over the segment that starts at height origin_y and runs path_length along a direction whose
// vertical component is direction_y (-1..1). With x = |direction_y| path_length / falloff it is the density at the
// lower end times (1 - exp(-x)) / x: no exponential can overflow, and a level ray (x = 0) needs no case.
float height_mean_density(float origin_y, float direction_y, float path_length, float base, float falloff) {
    float rise = direction_y * path_length;
    float low = origin_y + min(rise, 0.0f);
    return height_density(low, base, falloff) * mean_exponential(abs(rise) / falloff);
}

// Density length [m] of the segment: its integral of density; times sigma_t it is the optical depth.
float height_density_length(float origin_y, float direction_y, float path_length, float base, float falloff) {
    return path_length * height_mean_density(origin_y, direction_y, path_length, base, falloff);
}

// Density length [m] from a point to infinity along a direction whose vertical component is direction_y, as
// towards the sun: falloff * density / direction_y. A level or falling direction never leaves the medium: the
// length is HEIGHT_INFINITE_LENGTH and the transmittance 0.
float height_density_length_to_infinity(float origin_y, float direction_y, float base, float falloff) {
    if (direction_y <= 0.0f) {
        return HEIGHT_INFINITE_LENGTH;
    }
    return min(height_density(origin_y, base, falloff) * falloff / direction_y, HEIGHT_INFINITE_LENGTH);
}

#endif
