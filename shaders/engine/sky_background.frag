// The sky behind the scene: the sky cube, high clouds in streaks (CIRRUS: there are no others), the sun's disc.
#include "shaders/engine/frame_block.glsl"
#include "shaders/engine/sky_background.glsl"

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

layout(binding = 0) uniform samplerCube sky;

uniform vec3 to_sun;
uniform float illuminance;  // in units of light

void main() {
    vec4 far = frame.inverse_view_projection * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 d = normalize(far.xyz / far.w - frame.eye.xyz);
    vec3 radiance = textureLod(sky, d, 0.0).rgb;
#if CIRRUS
    radiance = sky_clouded(radiance, d, to_sun, illuminance);
#endif
    float edge = max(fwidth(sky_from_sun(d, to_sun)), 1e-4);
    radiance += sky_sun_disc(d, to_sun, frame.sun_illuminance.rgb, edge);
    color = vec4(min(radiance, vec3(SKY_BRIGHTEST)), 1.0);
}
