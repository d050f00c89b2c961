#include "engine/core/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/output_files.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void fail(const fs::path& path, std::string_view action, std::string_view reason) {
    throw Error(fmt::format("{}: cannot {}: {}", path.string(), action, reason));
}

template <class Container>
Container read_all(const fs::path& path) {
    if (fs::is_directory(path)) fail(path, "read", "it is a folder");
    const File file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file) fail(path, "read", std::strerror(errno));
    Container content;
    for (std::size_t size = 0, got = 1; got > 0; content.resize(size)) {
        content.resize(size + 65536);
        got = std::fread(content.data() + size, 1, content.size() - size, file.get());
        size += got;
    }
    if (std::ferror(file.get())) fail(path, "read", std::strerror(errno));
    return content;
}

/// RFC 3986, section 3.1: a letter, then letters, digits, "+", "-" and ".", then ":".
bool has_scheme(std::string_view uri) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto scheme_char = [&](char c) {
        return letter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    };
    const auto end = std::find_if_not(uri.begin(), uri.end(), scheme_char);
    return end != uri.end() && *end == ':' && letter(uri.front());
}

/// The largest number of arrays and objects inside one another.
int nesting_depth(std::string_view json) {
    int depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string && c == '\\') ++i;
        if (c == '"') in_string = !in_string;
        if (in_string) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if (c == ']' || c == '}') --depth;
    }
    return deepest;
}

}  // namespace

std::string read_text(const fs::path& path) {
    return read_all<std::string>(path);
}

std::vector<std::uint8_t> read_bytes(const fs::path& path) {
    return read_all<std::vector<std::uint8_t>>(path);
}

nlohmann::json parse_json(std::string_view text) {
    constexpr int deepest = 100;
    if (nesting_depth(text) > deepest)
        throw Error(fmt::format("the JSON is nested deeper than {} levels", deepest));
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& e) {
        const std::string_view message = e.what();  // "[json.exception.parse_error.101] parse error at line …"
        throw Error(std::string(message.substr(message.find(' ') + 1)));
    }
}

nlohmann::json read_json(const fs::path& path) {
    const std::string text = read_text(path);
    try {
        return parse_json(text);
    } catch (const Error& e) {
        throw Error(fmt::format("{}: {}", path.string(), e.what()));
    }
}

void write_text(const fs::path& path, const std::string& text) {
    OutputFiles files;
    files.add(path, text);
    files.commit();
}

fs::path resolve_inside(const fs::path& folder, const std::string& uri) {
    const auto reject = [&](std::string_view reason) {
        throw Error(fmt::format("{}: URI \"{}\" {}", folder.string(), uri, reason));
    };
    if (uri.empty()) reject("is empty");
    if (uri.find('\0') != std::string::npos) reject("holds a zero byte");
    if (has_scheme(uri)) reject("has a scheme; a path relative to the folder is expected");
    if (fs::path(uri).is_absolute()) reject("is absolute; a path relative to the folder is expected");
    std::error_code error;
    const fs::path root = fs::canonical(folder, error);
    if (error) reject("cannot be resolved: " + error.message());
    const fs::path target = fs::weakly_canonical(root / uri, error);
    if (error) reject("cannot be resolved: " + error.message());
    if (std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end()) {
        reject("leaves the folder");
    }
    return target;
}

}  // namespace tyndall
