// The visible share of what a part of a view ray gathers of a light, from the trees of epipolar.glsl.
#ifndef VOLUMETRICS_EPIPOLAR_SHARE_GLSL
#define VOLUMETRICS_EPIPOLAR_SHARE_GLSL

#include "shaders/lib/lamp_segment.glsl"
#include "shaders/shared/lights.h"
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/light/epipolar.glsl"
#include "shaders/volumetrics/media/extinction.glsl"

#ifndef GLASS
#define GLASS 0
#endif

layout(binding = 2) uniform sampler2D epipolar_table;
layout(binding = 3) uniform sampler2D epipolar_nodes;
uniform int coarsest_level;  // 0: cell after cell

// A view ray in its half plane.
struct EpipolarRay {
    int root;  // index of the line's nodes
    int cells;
    int last;  // cell that was made
    float slope;
    float cosine;  // of the ray's angle to the axis
    float sine;
    float distance;
    float cells_per_unit;
    bool glass;  // some of the sun's light along the line has come through glass
};

EpipolarRay epipolar_ray(int light, vec3 direction) {
    EpipolarLines lines = epipolar_lines(epipolar_table, light);
    float cosine = dot(direction, lines.axis);
    vec3 across = direction - cosine * lines.axis;
    float sine = length(across);
    int line = clamp(int(epipolar_line(lines, across)), 0, lines.lines - 1);
    float slope = clamp(cosine / max(sine, 1.0e-9), -EPIPOLAR_LARGEST, EPIPOLAR_LARGEST);
    int root = lines.nodes + line * 2 * lines.cells;
    bool glass = false;
#if GLASS & GLASS_SUN
    glass = texelFetch(epipolar_nodes, epipolar_texel(root), 0).y > 0.0;
#endif
    return EpipolarRay(root, lines.cells, lines.cells - 1, slope, cosine, sine, lines.distance, lines.cells_per_unit, glass);
}

// The place among the cells that the ray passes at the distance t, and of parallel light the distance of a place.
float epipolar_place(EpipolarRay ray, float t) {
    float units = ray.distance == 0.0 ? log(1.0 + t * ray.sine / EPIPOLAR_RADIUS)
                                      : atan(t * ray.sine, ray.distance - t * ray.cosine);
    return min(units * ray.cells_per_unit, float(ray.last + 1));
}
float epipolar_distance(EpipolarRay ray, float place) {
    return EPIPOLAR_RADIUS * (exp(place / ray.cells_per_unit) - 1.0) / max(ray.sine, 1.0e-9);
}

// How the light gathered between `begin` and `end` is spread: of the sun by exp(-fall) from one to the other; of a lamp by
// the inverse square, whose integral is `lamp`, and by the four nodes of the lamp's rule, whose light is `parts`.
struct Gathering {
    float begin;
    float end;
    float fall;
    bool of_lamp;
    LampIntegral lamp;
    vec4 parts;
};

const LampIntegral NO_LAMP = LampIntegral(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0);

// Where a ray passes a lamp among the cells: nearest to it, and into and out of the sphere of its radius.
struct LampPlaces {
    float nearest;
    float enter;
    float leave;
};

LampPlaces lamp_places(EpipolarRay ray, LampIntegral lamp) {
    float nearest = asin(clamp(ray.cosine, -1.0, 1.0));
    vec2 sphere = atan(vec2(lamp.enter, lamp.leave), vec2(lamp.h));
    return LampPlaces(nearest * ray.cells_per_unit, (nearest + sphere.x) * ray.cells_per_unit,
                      (nearest + sphere.y) * ray.cells_per_unit);
}

// The share of the light that is gathered before a place, where all begins at the place `first`. Parallel light is even over
// distance; inverse squares are over places, but within the sphere they are cut off, and even over distance.
float gathered_before(EpipolarRay ray, Gathering light, LampPlaces lamp, float place, float first) {
    float share;
    if (!light.of_lamp || ray.distance == 0.0) {
        share = (epipolar_distance(ray, place) - light.begin) / (light.end - light.begin);
    } else {
        float outside = min(place, lamp.enter) - first + max(place - lamp.leave, 0.0);
        float u = light.lamp.h * tan(clamp((place - lamp.nearest) / ray.cells_per_unit, -1.5707, 1.5707));
        float inside = clamp((u - light.lamp.enter) / max(light.lamp.leave - light.lamp.enter, 1.0e-9), 0.0, 1.0);
        float sum = outside / (ray.cells_per_unit * max(light.lamp.h, 1.0e-6)) + inside * light.lamp.inside;
        share = sum / light.lamp.total;
    }
    share = clamp(share, 0.0, 1.0);
    return light.of_lamp ? lamp_segment_share(light.parts, share) : share_before(share, light.fall);
}

// Of the largest node that begins with the cell and ends with `last` or before.
int epipolar_level(EpipolarRay ray, int cell, int last) {
    return min(min(findLSB(cell | ray.cells), findMSB(last - cell + 1)), coarsest_level);
}

// 0 .. 1. Light gathered is added where visibility begins and taken away where it ends.
float epipolar_share(EpipolarRay ray, Gathering light) {
    vec2 places = vec2(epipolar_place(ray, light.begin), epipolar_place(ray, light.end));
    int begin = min(int(places.x), ray.last);
    // The cell in which a ray meets a surface has its light end there too, and rounding would say whether before or behind
    // it: it is as the one before. So is the last cell of each part that ends within one.
    int last = clamp(int(places.y - 1.0), begin, ray.last);
    int cell = begin;
    // The only cell may have its middle beyond the part's end, as near the axis of parallel light.
    float slope = ray.slope;
    if (begin == last && ray.distance == 0.0) slope *= 0.5 * (places.x + places.y) / (float(begin) + 0.5);
    if (coarsest_level > 0) {
        vec2 whole = texelFetch(epipolar_nodes, epipolar_texel(ray.root + 1), 0).xy;
        count_work(WORK_TREE_NODES, 1u);
        if (slope >= whole.y) return 1.0;
        if (slope < whole.x) return 0.0;
    }
    LampPlaces lamp = lamp_places(ray, light.lamp);
    int level = epipolar_level(ray, cell, last);
    bool lit = false;
    float share = 0.0;
    while (cell <= last) {
        vec2 node = texelFetch(epipolar_nodes, epipolar_texel(ray.root + ((ray.cells + cell) >> level)), 0).xy;
        count_work(WORK_TREE_NODES, 1u);
        bool all_lit = slope >= node.y;
        if (!all_lit && slope >= node.x) {
            --level;
            continue;
        }
        if (all_lit != lit) {
            float before = cell == begin ? 0.0 : gathered_before(ray, light, lamp, float(cell), places.x);
            share += lit ? before : -before;
            lit = all_lit;
        }
        cell += 1 << level;
        level = epipolar_level(ray, cell, last);
    }
    return clamp(lit ? share + 1.0 : share, 0.0, 1.0);
}

#endif
