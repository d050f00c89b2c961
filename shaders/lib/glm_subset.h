#pragma once
// Lets C++ compile the pure functions of shaders/lib with GLM:
//
//     #include "shaders/lib/glm_subset.h"
//     TYNDALL_GLSL_BEGIN
//     #include "shaders/lib/phase.glsl"
//     TYNDALL_GLSL_END
//     ... tyndall::glsl::phase_henyey_greenstein(g, cos_theta) ...
//
// A file of shaders/lib, and shape.glsl with what it includes, keeps to what both languages read the same way:
// swizzles of one component, structs returned instead of out parameters and filled member by member, no arrays as
// values, no implicit conversions, float literals with the suffix f, unsigned ones with u. The functions have
// internal linkage, so any number of .cpp files may include them; do not include them from a header.

#include <glm/glm.hpp>

#define TYNDALL_GLSL_BEGIN                                                                \
    _Pragma("GCC diagnostic push")                                                        \
        _Pragma("GCC diagnostic ignored \"-Wunused-function\"") namespace tyndall::glsl { \
        namespace {                                                                       \
        using namespace glm;

#define TYNDALL_GLSL_END            \
    } /* namespace */               \
    } /* namespace tyndall::glsl */ \
    _Pragma("GCC diagnostic pop")
