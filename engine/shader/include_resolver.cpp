#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/shader/shader_library.h"

namespace tyndall {
namespace {

/// The path in a line `#include "shaders/…"`. Other includes (C++ headers in the C++ part of a shared file) are not
/// ours and stay.
std::optional<std::string> included_path(std::string_view line) {
    const auto skip_spaces = [&] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
    const auto skip = [&](std::string_view token) {
        skip_spaces();
        if (!line.starts_with(token)) return false;
        line.remove_prefix(token.size());
        return true;
    };
    if (!skip("#") || !skip("include") || !skip("\"") || !line.starts_with("shaders/")) return {};
    return std::string(line.substr(0, line.find('"')));
}

class Resolver {
  public:
    Resolver(const Roots& roots, std::vector<std::filesystem::path>& files) : roots_(roots), files_(files) {}

    void append(const std::string& path, const std::string& asked_by) {
        seen_.insert(path);
        const std::size_t number = files_.size();
        std::istringstream text(load(path, asked_by));
        out_ += fmt::format("#line 1 {}\n", number);
        std::string line;
        for (int n = 1; std::getline(text, line); ++n) {
            const std::optional<std::string> included = included_path(line);
            if (!included) {
                out_ += line + '\n';
            } else if (seen_.contains(*included)) {
                out_ += '\n';
            } else {
                append(*included, fmt::format("{}:{}: ", path, n));
                out_ += fmt::format("#line {} {}\n", n + 1, number);
            }
        }
    }
    std::string text() && { return std::move(out_); }

  private:
    std::string load(const std::string& path, const std::string& asked_by) {
        const std::size_t number = files_.size();
        try {
            files_.push_back(roots_.find(path));
            return read_text(files_.back());
        } catch (const Error& error) {
            if (files_.size() == number) files_.push_back(roots_.first(path));  // may come yet
            throw Error(fmt::format("{}shader file '{}' cannot be read: {}", asked_by, path, error.what()));
        }
    }

    const Roots& roots_;
    std::vector<std::filesystem::path>& files_;
    std::set<std::string> seen_;
    std::string out_;
};

}  // namespace

std::string resolve_includes(const Roots& roots, const std::string& path,
                             std::vector<std::filesystem::path>* files) {
    std::vector<std::filesystem::path> own;
    Resolver resolver(roots, files != nullptr ? *files : own);
    resolver.append(path, "");
    return std::move(resolver).text();
}

}  // namespace tyndall
