// A clear sky, as single scattering in an exponential Rayleigh and Mie atmosphere with an ozone shell over a round
// earth (the constants follow Bruneton and Neyret 2008 and Hillaire 2020), plus an isotropic estimate of what is
// scattered more than once. Lengths in km. In the subset of GLSL that C++ compiles too (shaders/lib/glm_subset.h).
#ifndef ENGINE_SKY_MODEL_GLSL
#define ENGINE_SKY_MODEL_GLSL

const float SKY_PI = 3.14159265358979f;
const float SKY_GROUND = 6360.0f;  // radius of the earth
const float SKY_TOP = 6440.0f;     // and of the end of the air
const float SKY_EYE = 0.3f;        // height of the eye
const float SKY_RAYLEIGH_HEIGHT = 8.0f;
const float SKY_MIE_HEIGHT = 1.2f;
const float SKY_MIE_G = 0.76f;
const float SKY_MIE_TURBIDITY = 2.2f;  // haze, in units of clean air's
const float SKY_MULTIPLE = 1.3f;  // scattered more than once, over what is scattered once
const int SKY_STEPS = 20;

// At sea level, per km; red, green, blue stand for 650, 550 and 445 nm.
vec3 sky_rayleigh() { return vec3(6.95e-3f, 13.558e-3f, 31.6e-3f); }
float sky_mie() { return 3.996e-3f * SKY_MIE_TURBIDITY; }
float sky_mie_extinction() { return 4.440e-3f * SKY_MIE_TURBIDITY; }
// Ozone, vertical optical depth of the whole layer (15 km at its densest), as a shell at 25 km.
vec3 sky_ozone() { return 15.0f * vec3(1.3e-3f, 1.881e-3f, 0.1e-3f); }

vec3 sky_ground_albedo() { return vec3(0.20f, 0.18f, 0.14f); }

// Radiance (cd/m^2) of a clear sky without sun and moon, airglow and stars: 22 magnitudes an arcsecond squared, which give
// the ground a thousandth of a lux.
vec3 sky_night() { return vec3(2.2e-4f, 2.5e-4f, 3.2e-4f); }

// Air mass of an exponential atmosphere: optical depth to infinity over the vertical one, for x = radius / scale height
// and the cosine to the zenith (Schueler 2012, "An Approximation to the Chapman Grazing-Incidence
// Function"). Within 16%, worst near 1 degree.
float sky_chapman(float x, float cosine) {
    float c = sqrt(0.5f * SKY_PI * x);
    if (cosine >= 0.0f) {
        return c / ((c - 1.0f) * cosine + 1.0f);
    }
    float lowest = x * sqrt(max(1.0f - cosine * cosine, 0.0f));  // where the ray passes nearest to the ground
    float c_lowest = sqrt(0.5f * SKY_PI * lowest);
    return 2.0f * c_lowest * exp(min(x - lowest, 60.0f)) - c / ((c - 1.0f) * -cosine + 1.0f);
}

// Transmittance from outside the air to a point at `radius` along a direction with that cosine to the zenith; 0 behind
// the earth, over a penumbra.
vec3 sky_transmittance(float radius, float cosine) {
    float height = radius - SKY_GROUND;
    float horizon = -sqrt(max(1.0f - SKY_GROUND * SKY_GROUND / (radius * radius), 0.0f));
    float lit = smoothstep(horizon - 0.02f, horizon + 0.01f, cosine);
    float grazing = max(cosine, horizon - 0.005f);
    float rayleigh = SKY_RAYLEIGH_HEIGHT * exp(-height / SKY_RAYLEIGH_HEIGHT) *
                     sky_chapman(radius / SKY_RAYLEIGH_HEIGHT, grazing);
    float mie = SKY_MIE_HEIGHT * exp(-height / SKY_MIE_HEIGHT) * sky_chapman(radius / SKY_MIE_HEIGHT, grazing);
    float sine = radius * sqrt(max(1.0f - grazing * grazing, 0.0f)) / (SKY_GROUND + 25.0f);
    float ozone = 1.0f / sqrt(max(1.0f - sine * sine, 0.01f));
    return lit * exp(-(sky_rayleigh() * rayleigh + sky_mie_extinction() * mie + sky_ozone() * ozone));
}

// Distance along a ray from the eye to the sphere of `radius`: its exit, or with `enter` its entry; < 0: it misses.
float sky_sphere(float cosine, float radius, bool enter) {
    float r = SKY_GROUND + SKY_EYE;
    float b = r * cosine;
    float discriminant = b * b - r * r + radius * radius;
    if (discriminant < 0.0f) {
        return -1.0f;
    }
    return enter ? -b - sqrt(discriminant) : -b + sqrt(discriminant);
}

float sky_luminance(vec3 c) {
    return dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}

// Illuminance outside the air of a sun that gives `illuminance` lux at the ground. White: the air makes the colour. The
// sun's dimming is not undone entirely where it is deepest, so that a low sun keeps a sky in proportion to it.
float sky_extraterrestrial(float illuminance, float sun_height) {
    float arriving = sky_luminance(sky_transmittance(SKY_GROUND + SKY_EYE, max(sun_height, 0.0f)));
    return illuminance / (arriving + 0.12f);
}

// Radiance (cd/m^2) from direction `d` (unit, +Y up) without the disc of the sun, which stands at the unit vector
// `sun` and gives `illuminance` lux; 0: there is none, and it is night. Below the horizon it is a lit ground seen through
// the air.
vec3 sky_radiance(vec3 d, vec3 sun, float illuminance) {
    float ground = sky_sphere(d.y, SKY_GROUND, true);
    vec3 night = ground > 0.0f ? sky_ground_albedo() * sky_night() : sky_night();
    if (illuminance <= 0.0f) {
        return night;
    }
    float end = ground > 0.0f ? ground : sky_sphere(d.y, SKY_TOP, false);
    float cos_theta = dot(d, sun);
    float rayleigh_phase = 3.0f / (16.0f * SKY_PI) * (1.0f + cos_theta * cos_theta);
    float g = SKY_MIE_G;
    float bracket = 1.0f + g * g - 2.0f * g * cos_theta;
    float mie_phase = (1.0f - g * g) / (4.0f * SKY_PI * bracket * sqrt(bracket));

    vec3 radiance = vec3(0.0f);
    vec3 transmittance = vec3(1.0f);
    float t = 0.0f;
    for (int i = 0; i < SKY_STEPS; ++i) {
        float s = float(i + 1) / float(SKY_STEPS);
        float next = end * s * s;
        float middle = 0.5f * (t + next);
        float r = SKY_GROUND + SKY_EYE;
        float radius = sqrt(r * r + middle * middle + 2.0f * r * d.y * middle);
        float height = max(radius - SKY_GROUND, 0.0f);
        float sun_cosine = (r * sun.y + middle * cos_theta) / radius;
        vec3 rayleigh = sky_rayleigh() * exp(-height / SKY_RAYLEIGH_HEIGHT);
        float mie = exp(-height / SKY_MIE_HEIGHT);
        float ozone = max(1.0f - abs(height - 25.0f) / 15.0f, 0.0f) / 15.0f;

        vec3 scattering = rayleigh + vec3(sky_mie() * mie);
        vec3 extinction = rayleigh + vec3(sky_mie_extinction() * mie) + sky_ozone() * ozone;
        vec3 direct = sky_transmittance(max(radius, SKY_GROUND), sun_cosine);
        // What was scattered before comes from the whole sky: it sees the sun as if it stood higher, and lasts longer.
        float diffuse_cosine = 0.5f * (sun_cosine + sqrt(sun_cosine * sun_cosine + 0.06f));
        vec3 diffuse = sky_transmittance(max(radius, SKY_GROUND), diffuse_cosine) *
                       smoothstep(-0.25f, 0.25f, sun_cosine);
        vec3 source = direct * (rayleigh * rayleigh_phase + vec3(sky_mie() * mie * mie_phase)) +
                      diffuse * scattering * (SKY_MULTIPLE / (4.0f * SKY_PI));
        vec3 step_transmittance = exp(-extinction * (next - t));
        radiance += transmittance * source * (vec3(1.0f) - step_transmittance) / extinction;
        transmittance *= step_transmittance;
        t = next;
    }
    if (ground > 0.0f) {
        // Its illuminance by the sun and, roughly, by the sky, over the sun's outside the air.
        vec3 lit = sky_transmittance(SKY_GROUND, sun.y) * max(sun.y, 0.0f) +
                   vec3(0.05f, 0.06f, 0.08f) * smoothstep(-0.1f, 0.3f, sun.y);
        radiance += transmittance * sky_ground_albedo() * lit / SKY_PI;
    }
    return radiance * sky_extraterrestrial(illuminance, sun.y) + night;
}

#endif
