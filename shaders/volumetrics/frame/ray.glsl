// The view ray of a pixel.
#ifndef VOLUMETRICS_RAY_GLSL
#define VOLUMETRICS_RAY_GLSL

#include "shaders/lib/depth.glsl"
#include "shaders/volumetrics/frame/data.glsl"

struct Ray {
    vec3 origin;
    vec3 direction;        // unit, world
    float forward_cosine;  // with the camera's axis: view depth / distance
    vec2 uv;               // of the pixel, 0..1, origin lower left
    vec3 visibility_direction;  // the direction in which visibility is sampled; its points have the view depths of the ray's
};

// Where on the screen (0..1) a pixel of the chosen resolution looks: the middle of what it covers of it. At the far borders
// blocks may reach beyond: there it is the middle of the part inside.
vec2 screen_place(vec2 frag_coord) {
    vec2 place = frag_coord * volumetrics.target.zw;
    return min(place, 0.5 * (place - 0.5 * volumetrics.target.zw + 1.0));
}

// Clip coordinates on the screen as those of what is drawn to at the chosen resolution: linear, so that the first and the last
// pixel of a row and a column see what is at their screen_place; so do those between where blocks fill the screen, and else
// they are less than half a pixel off.
vec4 target_clip(vec4 clip) {
    if (volumetrics.target == volumetrics.viewport) return clip;
    vec2 pixels = volumetrics.target.xy;
    vec2 pixel = min(volumetrics.target.zw, 1.0);  // of the screen
    vec2 scale = mix(2.0 * (pixels - 1.0) / ((pixels - 2.0) * pixel + 1.0), vec2(1.0), equal(pixels, vec2(1.0)));
    vec2 offset = 0.5 - 0.5 * scale * pixel;  // px = scale * place + offset
    clip.xy = (scale * (clip.xy + clip.w) + 2.0 * offset * clip.w) / pixels - clip.w;
    return clip;
}

Ray view_ray(vec2 uv) {
    vec4 p = volumetrics.inverse_projection * vec4(uv * 2.0 - 1.0, 1.0, 1.0);  // on the near plane
    vec3 view_direction = normalize(p.xyz / p.w);
    vec3 direction = mat3(volumetrics.inverse_view) * view_direction;
    return Ray(volumetrics.eye.xyz, direction, -view_direction.z, uv, direction);
}

// Metres across at a distance along a ray, of one of `columns` equal parts of the screen's width.
float width_at(Ray ray, float t, float columns) {
    return 2.0 * abs(volumetrics.inverse_projection[0][0]) * t * ray.forward_cosine / columns;
}

#endif
