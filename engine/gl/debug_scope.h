#pragma once

#include <string_view>

#include "engine/gl/handle.h"

namespace tyndall::gl {

/// A GL debug group for as long as it lives: what a frame debugger shows as a region.
class DebugScope {
  public:
    explicit DebugScope(std::string_view name);
    ~DebugScope();
    DebugScope(const DebugScope&) = delete;
    DebugScope& operator=(const DebugScope&) = delete;
};

void label(GLenum identifier, GLuint name, std::string_view text);

}  // namespace tyndall::gl
