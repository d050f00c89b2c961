#include "engine/scene/json_field.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/files.h"

namespace tyndall {

void JsonField::fail(std::string_view expected) const {
    std::string text = json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    throw Error(fmt::format("{}: {} given, {} expected", where, text, expected));
}

JsonField JsonField::at(const char* key) const {
    if (!json.contains(key)) throw Error(fmt::format("{}: \"{}\" is missing", where, key));
    return {json.at(key), where + "." + key};
}

void JsonField::require_object(const std::vector<std::string_view>& keys) const {
    if (!json.is_object()) fail("an object");
    for (const auto& item : json.items()) {
        if (std::ranges::find(keys, item.key()) == keys.end())
            throw Error(fmt::format("{}: unknown key {}; {} expected", where, nlohmann::json(item.key()).dump(),
                                    fmt::join(keys, ", ")));
    }
}

std::string JsonField::text() const {
    if (!json.is_string() || json.get_ref<const std::string&>().empty()) fail("a text");
    return json.get<std::string>();
}

std::filesystem::path JsonField::file_in(const std::filesystem::path& folder) const {
    const std::string name = text();
    if (std::ranges::any_of(name, [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
        fail("a path without control characters");
    if (std::ranges::count(std::filesystem::path(name), "..") > 0) fail("a path without \"..\"");
    try {
        return resolve_inside(folder.empty() ? "." : folder, name);
    } catch (const Error& e) {
        throw Error(fmt::format("{}: {}", where, e.what()));
    }
}

std::size_t JsonField::choice(const std::vector<std::string_view>& names) const {
    for (std::size_t i = 0; i < names.size(); ++i)
        if (json == names[i]) return i;
    fail(fmt::format("one of {}", fmt::join(names, ", ")));
}

glm::quat JsonField::rotation() const {
    const glm::vec4 q = vector<4>(&JsonField::place);
    if (std::abs(glm::length(q) - 1) > 0.01F) fail("a unit quaternion [x, y, z, w]");
    return glm::normalize(glm::quat(q.w, q.x, q.y, q.z));
}

}  // namespace tyndall
