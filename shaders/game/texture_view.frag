// One layer or slice of any texture, mapped from [u_low, u_high] to display values.
#define VIEW_2D 0
#define VIEW_2D_ARRAY 1
#define VIEW_3D 2
#define VIEW_CUBE 3

#if VIEW == VIEW_2D
layout(binding = 0) uniform sampler2D u_texture;
#elif VIEW == VIEW_2D_ARRAY
layout(binding = 0) uniform sampler2DArray u_texture;
#elif VIEW == VIEW_3D
layout(binding = 0) uniform sampler3D u_texture;
#else
layout(binding = 0) uniform samplerCube u_texture;
#endif
uniform float u_slice;   // layer, slice centre 0..1, or cube face 0..5
uniform float u_low, u_high;
uniform int u_channels;  // 0 rgb, 1 red, 2 green, 3 blue, 4 alpha
uniform vec2 u_size;     // of the picture drawn, px
layout(location = 0) out vec4 out_color;

vec4 fetch(vec2 uv) {
#if VIEW == VIEW_2D
    return textureLod(u_texture, uv, 0.0);
#elif VIEW == VIEW_2D_ARRAY || VIEW == VIEW_3D
    return textureLod(u_texture, vec3(uv, u_slice), 0.0);
#else
    vec2 p = uv * 2.0 - 1.0;
    int face = int(u_slice);
    vec3 d = face == 0 ? vec3(1.0, p.y, -p.x) : face == 1 ? vec3(-1.0, p.y, p.x) : face == 2 ? vec3(p.x, 1.0, -p.y)
           : face == 3 ? vec3(p.x, -1.0, p.y) : face == 4 ? vec3(p.x, p.y, 1.0) : vec3(-p.x, p.y, -1.0);
    return textureLod(u_texture, d, 0.0);
#endif
}

void main() {
    vec4 texel = fetch(gl_FragCoord.xy / u_size);
    vec3 v = u_channels == 0 ? texel.rgb : vec3(texel[u_channels - 1]);
    v = clamp((v - u_low) / max(u_high - u_low, 1e-9), 0.0, 1.0);
    out_color = vec4(pow(v, vec3(1.0 / 2.2)), 1.0);
}
