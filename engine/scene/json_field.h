#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

/// A JSON value and where it is, for messages.
struct JsonField {
    const nlohmann::json& json;
    std::string where;

    [[noreturn]] void fail(std::string_view expected) const;
    [[nodiscard]] bool has(const char* key) const { return json.contains(key); }
    [[nodiscard]] JsonField at(const char* key) const;
    void require_object(const std::vector<std::string_view>& keys) const;

    [[nodiscard]] float number(std::string_view expected, auto valid) const {
        const float value = json.is_number() ? json.get<float>() : NAN;
        if (!std::isfinite(value) || !valid(value)) fail(expected);
        return value;
    }
    // Metres: as far as nodes may be, and not so small that squares and inverses leave the range of numbers.
    [[nodiscard]] float place() const {
        return number("a number from -1e9 to 1e9", [](float v) { return std::abs(v) <= 1e9F; });
    }
    [[nodiscard]] float size() const {
        return number("a number from 1e-6 to 1e9", [](float v) { return v >= 1e-6F && v <= 1e9F; });
    }
    [[nodiscard]] float width() const {
        return number("a number from 0 to 1e9", [](float v) { return v >= 0 && v <= 1e9F; });
    }
    [[nodiscard]] float share() const {
        return number("a number from 0 to 1", [](float v) { return v >= 0 && v <= 1; });
    }
    // Far beyond any matter, and such that products with densities, lengths and light stay finite.
    [[nodiscard]] float coefficient() const {
        return number("a number from 0 to 1e6", [](float v) { return v >= 0 && v <= 1e6F; });
    }
    [[nodiscard]] float radiance() const {
        return number("a number from 0 to 1e12", [](float v) { return v >= 0 && v <= 1e12F; });
    }
    // Metres a second.
    [[nodiscard]] float velocity() const {
        return number("a number from -1e4 to 1e4", [](float v) { return std::abs(v) <= 1e4F; });
    }
    [[nodiscard]] std::string text() const;
    /// Of an existing or a missing file in `folder`, never outside of it.
    [[nodiscard]] std::filesystem::path file_in(const std::filesystem::path& folder) const;
    /// One of `names`, by its index.
    [[nodiscard]] std::size_t choice(const std::vector<std::string_view>& names) const;
    template <int n>
    [[nodiscard]] glm::vec<n, float> vector(float (JsonField::*element)() const) const {
        if (!json.is_array() || json.size() != n) fail(fmt::format("a list of {} numbers", n));
        glm::vec<n, float> v;
        for (int i = 0; i < n; ++i)
            v[i] = (JsonField{json[static_cast<std::size_t>(i)], fmt::format("{}[{}]", where, i)}.*element)();
        return v;
    }
    /// A unit quaternion [x, y, z, w].
    [[nodiscard]] glm::quat rotation() const;
};

}  // namespace tyndall
