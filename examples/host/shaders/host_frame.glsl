// The host's frame, as its own shaders and the module's read it.
layout(std140, binding = 0) uniform HostFrame {
    mat4 host_world_to_clip;
    mat4 host_world_to_shadow;  // place and depth in the shadow map, each 0..1
    vec4 host_sun_direction;    // in which its light travels, unit; w metres of the shadow map's depths 0..1
    vec4 host_sun_illuminance;
    vec4 host_ambient;          // radiance, the same from all sides
    vec4 host_lamp_position;    // m; w range
    vec4 host_lamp_intensity;   // w radius, m
};
layout(binding = 8) uniform sampler2DShadow host_shadow_map;
layout(binding = 9) uniform sampler2D host_shadow_depth;  // the same texture, without a comparison

// Share 0..1 of the sun that reaches a point, between the four nearest texels. `offset` in texels.
float host_sun_visibility(vec3 world, vec2 offset) {
    vec3 at = (host_world_to_shadow * vec4(world, 1.0)).xyz;
    at.xy += offset / vec2(textureSize(host_shadow_map, 0));
    return textureLod(host_shadow_map, at, 0.0);
}
