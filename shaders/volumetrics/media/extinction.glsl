// Transmittance is computed once where no medium's extinction is coloured, else per channel (CHROMATIC 1).
#ifndef VOLUMETRICS_EXTINCTION_GLSL
#define VOLUMETRICS_EXTINCTION_GLSL

#if CHROMATIC
#define Extinction vec3
Extinction to_extinction(vec3 v) { return v; }
float largest(Extinction v) { return max(v.r, max(v.g, v.b)); }
float smallest(Extinction v) { return min(v.r, min(v.g, v.b)); }
float average(Extinction v) { return dot(v, vec3(1.0 / 3.0)); }
#else
#define Extinction float
Extinction to_extinction(vec3 v) { return v.r; }
float largest(Extinction v) { return v; }
float smallest(Extinction v) { return v; }
float average(Extinction v) { return v; }
#endif

// (1 - exp(-x)) / x, the mean of exp(-s) over 0 <= s <= x, given exp(-x), for x >= 0: from its series below 0.1, where
// the difference would cancel and the first neglected term is 1.4e-8.
Extinction mean_transmittance(Extinction x, Extinction transmittance) {
    Extinction s = min(x, 0.1);
    Extinction thin = 1.0 - s * (1.0 / 2.0 - s * (1.0 / 6.0 - s * (1.0 / 24.0 - s * (1.0 / 120.0))));
    Extinction thick = (1.0 - transmittance) / max(x, 0.1);
    return mix(thin, thick, step(0.1, x));
}

// The fraction u of the way into a segment of optical depth x where a share xi of the light that leaves its front
// has been gathered: int_0^u exp(-x s) ds = xi int_0^1 exp(-x s) ds. Samples are placed where they count.
float equal_transmittance(float xi, float x) {
    if (abs(x) < 0.01) return xi;
    float limited = clamp(x, -80.0, 80.0);
    return clamp(-log(1.0 - xi * (1.0 - exp(-limited))) / limited, 0.0, 1.0);
}

// The inverse: the share gathered before u.
float share_before(float u, float x) {
    if (abs(x) < 0.01) return u;
    float limited = clamp(x, -80.0, 80.0);
    return (1.0 - exp(-limited * u)) / (1.0 - exp(-limited));
}

#endif
