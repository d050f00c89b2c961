#ifndef TYNDALL_LIB_TONEMAP
#define TYNDALL_LIB_TONEMAP

// From exposed luminance (1 is the level at which a sensor saturates) to display-linear 0..1.

// Middle grey: the metered mean of a scene lies at 0.125 * 2^EV100 cd/m^2 (ISO 2720, K = 12.5), saturation at
// 1.2 * 2^EV100 (ISO 12232, as in Lagarde and de Rousiers 2014), and it shows as 18% reflectance.
const float TONEMAP_GREY = 0.125f / 1.2f;
const float TONEMAP_GREY_SHOWN = 0.18f;
const float TONEMAP_SLOPE = 1.42f;

// Share of the mean of the channels that is mixed into each before the curve, and the part of it taken out after.
const float TONEMAP_INSET = 0.14f;
const float TONEMAP_OUTSET = 0.10f;

// How far hue is held: at 0 each channel goes its own way and fire turns yellow, at 1 it stays the red it was.
const float TONEMAP_KEEP_HUE = 0.7f;

// Naka and Rushton 1966, the response of a photoreceptor: y = x^n / (x^n + s^n), a sigmoid in log exposure with a toe,
// a straight part and a shoulder that ends at 1. s follows from TONEMAP_GREY -> TONEMAP_GREY_SHOWN.
float tonemap_curve(float x) {
    float half_level = pow(TONEMAP_GREY, TONEMAP_SLOPE) * (1.0f / TONEMAP_GREY_SHOWN - 1.0f);
    float power = pow(clamp(x, 0.0f, 1.0e6f), TONEMAP_SLOPE);
    return power / (power + half_level);
}

// The curve per channel, inside slightly narrower primaries (the idea of Sobotka's AgX): every channel gets a share of
// the others, so that a saturated lamp turns paler as it gets brighter instead of clipping. A curve per channel also
// bends hue; the affine map that takes the least and the greatest channel where the curve takes them leaves the
// third at its place between them, which is its hue in HSV. Grey stays grey.
vec3 tonemap(vec3 exposed) {
    vec3 c = max(exposed, vec3(0.0f));
    vec3 inset = mix(c, vec3((c.x + c.y + c.z) / 3.0f), TONEMAP_INSET);
    vec3 shown = vec3(tonemap_curve(inset.x), tonemap_curve(inset.y), tonemap_curve(inset.z));
    float lo = min(min(inset.x, inset.y), inset.z);
    float hi = max(max(inset.x, inset.y), inset.z);
    float lo_shown = min(min(shown.x, shown.y), shown.z);
    float hi_shown = max(max(shown.x, shown.y), shown.z);
    vec3 same_hue = vec3(lo_shown) + (inset - vec3(lo)) * ((hi_shown - lo_shown) / max(hi - lo, 1.0e-6f));
    shown = mix(shown, same_hue, TONEMAP_KEEP_HUE);
    vec3 mean = vec3((shown.x + shown.y + shown.z) / 3.0f);
    return clamp(mean + (shown - mean) / (1.0f - TONEMAP_OUTSET), vec3(0.0f), vec3(1.0f));
}

// IEC 61966-2-1.
float srgb_encode(float linear_value) {
    if (linear_value <= 0.0031308f) {
        return 12.92f * linear_value;
    }
    return 1.055f * pow(linear_value, 1.0f / 2.4f) - 0.055f;
}

#endif
