// What lets one header be read by C++ and GLSL. Structs go between SHARED_BEGIN and SHARED_END and are made of
// 16-byte groups, so that std140, std430 and C++ agree; tests compare offsetof with what the driver reflects.
#ifndef SHARED_TYPES_H
#define SHARED_TYPES_H

#ifdef TYNDALL_GLSL
#define SHARED_BEGIN
#define SHARED_END
#else
#include <glm/glm.hpp>
#define SHARED_BEGIN               \
    namespace tyndall::shared {    \
    using glm::ivec4, glm::mat4, glm::uvec4, glm::vec4, glm::uvec2; \
    using uint = unsigned;
#define SHARED_END }
#endif

#endif
