#include "shaders/shared/bindings.h"
#include "shaders/engine/visible_lights.h"

layout(std430, binding = BINDING_VISIBLE_LIGHTS) buffer VisibleLightBuffer {
    VisibleLightsHeader visible_header;
    VisibleLight visible_lights[];
};
