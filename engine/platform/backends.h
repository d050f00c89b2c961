#pragma once

#include <memory>

#include "engine/platform/gl_context.h"

/// One function per back end; each throws Error with the reason why it has no context to give.
namespace tyndall {
[[nodiscard]] std::unique_ptr<GlContext> create_egl_context(const ContextRequest& request);
[[nodiscard]] std::unique_ptr<GlContext> create_osmesa_context(const ContextRequest& request);
[[nodiscard]] std::unique_ptr<GlContext> create_glfw_context(const ContextRequest& request);
}  // namespace tyndall
