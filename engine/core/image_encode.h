#pragma once

#include <filesystem>
#include <string>

#include "engine/core/image.h"

namespace tyndall {

/// The bytes that write_image writes, by the extension of `path`. Throws Error naming the path.
[[nodiscard]] std::string encode_image(const std::filesystem::path& path, const Image& image);

}  // namespace tyndall
