#include "engine/core/roots.h"

#include <fmt/format.h>

#include "engine/core/check.h"
#include "engine/core/error.h"

namespace tyndall {

namespace fs = std::filesystem;

fs::path Roots::find(const fs::path& path) const {
    std::string looked;
    for (const fs::path& folder : folders_) {
        fs::path file = folder / path;
        if (fs::is_regular_file(file)) return file;
        looked += (looked.empty() ? "" : ", ") + folder.string();
    }
    throw Error(fmt::format("{}: no such file in {}", path.string(), looked));
}

fs::path Roots::first(const fs::path& path) const {
    TYNDALL_CHECK(!folders_.empty());
    return folders_.front() / path;
}

std::string Roots::name_of(const fs::path& file) const {
    for (const fs::path& folder : folders_) {
        const fs::path name = file.lexically_relative(folder);
        if (!name.empty() && *name.begin() != "..") return name.string();
    }
    return file.string();
}

}  // namespace tyndall
