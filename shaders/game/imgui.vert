// Dear ImGui's triangles: positions in pixels from the top left, colours packed RGBA8 and already display encoded.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in uint color;
uniform vec2 u_display_size;
out vec2 v_uv;
out vec4 v_color;

void main() {
    v_uv = uv;
    v_color = unpackUnorm4x8(color);
    vec2 ndc = position / u_display_size * 2.0 - 1.0;
    gl_Position = vec4(ndc.x, -ndc.y, 0.0, 1.0);
}
