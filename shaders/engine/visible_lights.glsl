#include "shaders/shared/bindings.h"
#include "shaders/engine/visible_lights.h"

layout(std430, binding = BINDING_VISIBLE_LIGHTS) buffer VisibleLightBuffer {
    VisibleLightsHeader visible_header;
    VisibleLight visible_lights[];
};
// For each column of clusters over the screen, then for each row, then for each slice: the visible lamps whose box covers
// it, a bit each. What lies in all three of a cluster's lists may reach it.
layout(std430, binding = BINDING_VISIBLE_ROWS) buffer VisibleRowBuffer { uint visible_rows[]; };

uint row_words(uint light_count) { return (light_count + 31u) / 32u; }
