// What a transparent surface leaves of light that crosses it, at any angle, without refraction:
//     filter = (1 - alpha) + alpha transmission base_color
// transmission 0 (plain blending) is grey, 1 (stained glass) is as coloured as the surface; alpha 0 is no surface.
#ifndef ENGINE_GLASS_FILTER_GLSL
#define ENGINE_GLASS_FILTER_GLSL

uniform float transmission;

vec3 glass_filter(vec4 base_color) {
    float alpha = clamp(base_color.a, 0.0, 1.0);
    return 1.0 - alpha + alpha * transmission * clamp(base_color.rgb, 0.0, 1.0);
}

#endif
