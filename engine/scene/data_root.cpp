#include "engine/scene/data_root.h"

#include <fmt/format.h>

#include <cstdlib>

#include "engine/core/error.h"

namespace tyndall {

std::filesystem::path data_root() {
    const char* chosen = std::getenv("TYNDALL_DATA");
    std::filesystem::path root = chosen != nullptr ? chosen : TYNDALL_SOURCE_DIR;
    if (!std::filesystem::is_directory(root / "shaders")) {
        throw Error(fmt::format("{}: no folder shaders/ here; set TYNDALL_DATA to the folder that holds it",
                                root.string()));
    }
    return root;
}

}  // namespace tyndall
