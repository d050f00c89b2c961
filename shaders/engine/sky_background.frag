// The sky behind the scene: the sky cube, high clouds in streaks, the sun's disc.
#include "shaders/engine/frame_block.glsl"
#include "shaders/engine/sky_model.glsl"

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

layout(binding = 0) uniform samplerCube sky;

uniform vec3 to_sun;
uniform float illuminance;  // lux

const float SUN_RADIUS = 0.00465;  // rad; half of 0.533 degrees
const float CLOUD_HEIGHT = 7.0;    // km

float lattice(ivec2 p) {
    uint h = uint(p.x) * 0x9e3779b9u ^ uint(p.y) * 0x85ebca6bu;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return float((h ^ (h >> 15)) >> 8) / 16777216.0;
}

float value_noise(vec2 p) {
    ivec2 i = ivec2(floor(p));
    vec2 f = p - floor(p);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(lattice(i), lattice(i + ivec2(1, 0)), f.x),
               mix(lattice(i + ivec2(0, 1)), lattice(i + ivec2(1, 1)), f.x), f.y);
}

// Opacity of cirrus where a ray that rises by d.y meets a flat layer: noise drawn out along the wind.
float cirrus(vec3 d) {
    vec2 p = d.xz * (CLOUD_HEIGHT / (d.y + 0.06));
    vec2 along = vec2(0.86, 0.51);
    p = vec2(dot(p, along) * 0.045, dot(p, vec2(-along.y, along.x)) * 0.17);
    p.y += 0.7 * value_noise(p * 0.6 + 3.0);
    float sum = 0.0, weight = 0.5;
    for (int octave = 0; octave < 4; ++octave) {
        sum += weight * value_noise(p);
        p = mat2(1.6, 1.2, -1.2, 1.6) * p + 11.0;
        weight *= 0.5;
    }
    float streaks = smoothstep(0.46, 0.85, sum);
    // Thin overhead, and lost in the haze at the horizon.
    return 0.75 * streaks * smoothstep(0.015, 0.12, d.y) * (1.0 - 0.6 * d.y);
}

void main() {
    vec4 far = frame.inverse_view_projection * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 d = normalize(far.xyz / far.w - frame.eye.xyz);
    vec3 radiance = textureLod(sky, d, 0.0).rgb;

    if (d.y > 0.0) {
        // Lit by the sun at its height, with a forward lobe around the sun, and by the sky behind and above.
        float forward = max(dot(d, to_sun), 0.0);
        vec3 sunlight = sky_transmittance(SKY_GROUND + CLOUD_HEIGHT, to_sun.y) *
                        sky_extraterrestrial(illuminance, to_sun.y);
        vec3 cloud = sunlight * (0.055 + 0.16 * pow(forward, 12.0)) + 0.55 * radiance;
        radiance = mix(radiance, cloud, cirrus(d));
    }
    // The disc's radiance is its illuminance over its solid angle, darkened to the limb (1 - 0.6 (1 - cos)), which
    // takes a fifth off the mean; half floats and the tonemap need no more than 60000.
    float from_center = length(d - to_sun) / SUN_RADIUS;
    float edge = max(fwidth(from_center), 1e-4);
    float disc = clamp((1.0 - from_center) / edge + 0.5, 0.0, 1.0) * step(0.0, d.y);
    float limb = 0.4 + 0.6 * sqrt(max(1.0 - from_center * from_center, 0.0));
    vec3 sun = frame.sun_illuminance.rgb * (limb / (0.8 * SKY_PI * SUN_RADIUS * SUN_RADIUS));
    color = vec4(min(radiance + disc * sun, vec3(60000.0)), 1.0);
}
