// One triangle over the whole viewport, at the far plane of reversed depth. uv is 0..1, origin lower left.
layout(location = 0) out vec2 uv;

void main() {
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
}
