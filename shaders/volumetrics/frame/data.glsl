// The module's uniform block: this frame's view, settings and global media.
#ifndef VOLUMETRICS_DATA_GLSL
#define VOLUMETRICS_DATA_GLSL

#include "shaders/shared/bindings.h"
#include "shaders/shared/volumetrics.h"

layout(std140, binding = BINDING_VOLUMETRICS) uniform VolumetricsBlock { VolumetricsData volumetrics; };

#endif
