#ifndef ENGINE_FRAME_BLOCK_GLSL
#define ENGINE_FRAME_BLOCK_GLSL

#include "shaders/shared/bindings.h"
#include "shaders/shared/frame.h"

layout(std140, binding = BINDING_FRAME) uniform FrameBlock { FrameData frame; };

#endif
