// Nothing but depth; alpha-masked materials have holes.

#if ALPHA_MASK
in vec2 surface_uv;
in float vertex_alpha;
layout(binding = 0) uniform sampler2D base_color;
uniform float alpha_factor;
uniform float alpha_cutoff;
#endif

void main() {
#if ALPHA_MASK
    if (texture(base_color, surface_uv).a * alpha_factor * vertex_alpha < alpha_cutoff) discard;
#endif
}
