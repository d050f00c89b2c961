// Lambert's law under the sun, the lamp and the ambient light.
layout(location = 3) uniform vec3 albedo;
in vec3 world;
in vec3 normal;
out vec4 color;

void main() {
    float sun = 0.0;  // nine lookups, two texels apart
    for (int i = 0; i < 9; ++i)
        sun += host_sun_visibility(world + 0.02 * normal, 2.0 * vec2(i % 3 - 1, i / 3 - 1)) / 9.0;
    vec3 to_lamp = host_lamp_position.xyz - world;
    float d2 = dot(to_lamp, to_lamp);
    vec3 light = host_sun_illuminance.rgb * sun * max(dot(normal, -host_sun_direction.xyz), 0.0) +
                 host_lamp_intensity.rgb * max(dot(normal, to_lamp), 0.0) / (d2 * sqrt(d2));
    color = vec4(albedo * (light / 3.14159265 + host_ambient.rgb), 1.0);
}
