// Anti-aliasing of what is about to be scaled up, after Lottes, "FXAA" (2009): a mean of samples along the edge, which
// runs across the gradient of luma. A long mean whose luma is none that the neighbours have crosses another edge: then
// the short one is taken. Without an edge both are the pixel.
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

layout(binding = 0) uniform sampler2D picture;  // display values, linear filter

const float longest = 8.0;  // px along an edge

vec3 at(vec2 place) { return textureLod(picture, place, 0.0).rgb; }
float luma(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }

void main() {
    vec2 texel = 1.0 / vec2(textureSize(picture, 0));
    // Left below, right below, left above, right above.
    vec4 corners = vec4(luma(at(uv - texel)), luma(at(uv + vec2(texel.x, -texel.y))),
                        luma(at(uv + vec2(-texel.x, texel.y))), luma(at(uv + texel)));
    float middle = luma(at(uv));
    float low = min(middle, min(min(corners.x, corners.y), min(corners.z, corners.w)));
    float high = max(middle, max(max(corners.x, corners.y), max(corners.z, corners.w)));
    vec2 along = vec2(dot(corners, vec4(1.0, 1.0, -1.0, -1.0)), dot(corners, vec4(-1.0, 1.0, -1.0, 1.0)));
    float faint = max(dot(corners, vec4(1.0 / 32.0)), 1.0 / 128.0);  // no edge
    along = clamp(along / (min(abs(along.x), abs(along.y)) + faint), -longest, longest) * texel;
    vec3 near = 0.5 * (at(uv - along / 6.0) + at(uv + along / 6.0));
    vec3 far = 0.5 * near + 0.25 * (at(uv - 0.5 * along) + at(uv + 0.5 * along));
    float found = luma(far);
    color = vec4(found < low || found > high ? near : far, 1.0);
}
