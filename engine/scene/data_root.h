#pragma once

#include <filesystem>

namespace tyndall {

/// The folder that holds shaders/ and assets/ of the game: $TYNDALL_DATA, else the source folder the build was made
/// from. Throws Error where it has no shaders/.
[[nodiscard]] std::filesystem::path data_root();

}  // namespace tyndall
