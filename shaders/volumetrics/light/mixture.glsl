// Where to cut a ray through a mixture of global media: each alone is a closed form over any length, together they are not.
// y: height of the ray's begin; direction_y: vertical component of its unit direction. Lengths in m.
#ifndef VOLUMETRICS_MIXTURE_GLSL
#define VOLUMETRICS_MIXTURE_GLSL

#include "shaders/volumetrics/media/extinction.glsl"
#include "shaders/volumetrics/media/global_media.glsl"

// sigma_t at a height.
vec3 global_sigma_t(float y) { return global_medium(y, 0.0, 1.0).optical_depth; }

// Nothing shows behind 1e6 mean free paths of the medium at the ray's begin, nor where a falling ray has come 40 falloffs below
// the base. To go on would only cost precision.
float visible_end(float y, float direction_y, float surface) {
    vec3 sigma_t = global_sigma_t(y);
    float end = min(surface, 1.0e6 / max(max(sigma_t.r, max(sigma_t.g, sigma_t.b)), 1.0e-30));
#if HEIGHT_MEDIA
    if (direction_y < 0.0)
        for (uint i = 0u; i < HEIGHT_COUNT; ++i) {
            float falloff = volumetrics.height[i].sigma_t_falloff.w;
            float fall = max(y - volumetrics.height[i].sigma_s_base.w + 40.0 * falloff, falloff);
            end = min(end, fall / max(-direction_y, 1.0e-6));
        }
#endif
    return end;
}

// A mixture is cut at first ((1 + end / first)^(k / n) - 1), k = 1 .. n: densely at its begin, and evenly within `first`, on
// which none of its media changes by more than e^2, or at its begin is more than a mean free path of its densest channel (THICK).
// Behind `end` nothing shows, or no medium but the homogeneous is left.
struct Cuts {
    bool needed;
    float first;  // m
    float end;
};

Cuts find_cuts(float y, float direction_y, float end) {
    Cuts cuts = Cuts(false, end, end);
#if HEIGHT_MEDIA
    const float OPAQUE = 16.0;
    const float THICK = 1.0;
    vec3 homogeneous = volumetrics.homogeneous_sigma_t.rgb + volumetrics.homogeneous_emission.rgb;
    cuts.needed = HEIGHT_COUNT > 1u || (HEIGHT_COUNT == 1u && homogeneous != vec3(0.0));
    float thickest = 0.0;
    cuts.first = 1.0e30;
    cuts.end = min(end, OPAQUE / max(smallest(to_extinction(volumetrics.homogeneous_sigma_t.rgb)), 1.0e-30));
    for (uint i = 0u; cuts.needed && i < HEIGHT_COUNT; ++i) {
        HeightMedium medium = volumetrics.height[i];
        float scale = medium.sigma_t_falloff.w / max(abs(direction_y), 1.0e-6);  // m, on which it changes by e
        cuts.first = min(cuts.first, 2.0 * scale);
        float sigma_t = largest(to_extinction(medium.sigma_t_falloff.rgb)) *
                        height_density(y, medium.sigma_s_base.w, medium.sigma_t_falloff.w);
        cuts.first = min(cuts.first, THICK / max(sigma_t, 1.0e-30));
        thickest = max(thickest, scale);
        // Its depth is sigma scale (exp(t / scale) - 1) where the ray falls, sigma scale (1 - exp(-t / scale)) where it
        // rises, sigma at the ray's begin; x = log(OPAQUE / (sigma scale)), for sigma may be far below what a float can hold.
        float x = log(OPAQUE / max(smallest(to_extinction(medium.sigma_t_falloff.rgb)) * scale, 1.0e-30)) +
                  (y - medium.sigma_s_base.w) / medium.sigma_t_falloff.w;
        if (direction_y < 0.0)
            cuts.end = min(cuts.end, scale * (max(x, 0.0) + log(1.0 + exp(-abs(x)))));
        else if (x < 0.0)
            cuts.end = min(cuts.end, scale * -log(max(1.0 - exp(x), 1.0e-6)));
    }
    if (direction_y >= 0.0) cuts.end = min(cuts.end, OPAQUE * thickest);
#endif
    return cuts;
}

#endif
