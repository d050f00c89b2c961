#pragma once

#include <string_view>

namespace tyndall::gl {

/// Whether GL_RENDERER names one of Mesa's software rasterisers.
[[nodiscard]] inline bool is_software_driver(std::string_view renderer) {
    return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe") || renderer.starts_with("SWR");
}

}  // namespace tyndall::gl
