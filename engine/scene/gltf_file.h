#pragma once

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace tyndall::gltf {

using Json = nlohmann::json;

/// `text` without line breaks, cut to a length that a message can carry.
[[nodiscard]] std::string one_line(std::string text);

/// A parsed glTF file. What tinygltf does not check is checked here, on the way out: ranges, types and numbers.
/// Everything throws Error with the file's path. `what` names the part of the file in messages.
class GltfFile {
  public:
    explicit GltfFile(std::filesystem::path path);

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] const tinygltf::Model& model() const { return model_; }

    template <class... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
        throw Error(one_line(path_.string() + ": " + fmt::format(format, std::forward<Args>(args)...)));
    }
    /// Notes what is left out of a file that is otherwise drawn.
    template <class... Args>
    void skip(fmt::format_string<Args...> format, Args&&... args) const {
        skipped_.insert(one_line(fmt::format(format, std::forward<Args>(args)...)));
    }
    /// Notes what looks like a mistake of who made the file.
    template <class... Args>
    void doubt(fmt::format_string<Args...> format, Args&&... args) const {
        doubts_.insert(one_line(fmt::format(format, std::forward<Args>(args)...)));
    }
    /// What was left out, and what looks like a mistake, each once.
    [[nodiscard]] const std::set<std::string>& skipped() const { return skipped_; }
    [[nodiscard]] const std::set<std::string>& doubts() const { return doubts_; }

    template <class T>
    const T& at(const std::vector<T>& items, int index, const std::string& what) const {
        if (index < 0 || static_cast<std::size_t>(index) >= items.size())
            fail("{} {} does not exist; there are {}", what, index, items.size());
        return items[static_cast<std::size_t>(index)];
    }

    [[nodiscard]] float number(double value, const std::string& what, double min = -HUGE_VAL,
                               double max = HUGE_VAL) const;
    [[nodiscard]] float number(const Json& value, const std::string& what, double min = -HUGE_VAL,
                               double max = HUGE_VAL) const;
    [[nodiscard]] bool boolean(const Json& value, const std::string& what) const;
    template <int n>
    glm::vec<n, float> vector(const std::vector<double>& values, const std::string& what, double min = -HUGE_VAL,
                              double max = HUGE_VAL) const {
        if (values.size() != n) fail("{}: {} numbers given, {} expected", what, values.size(), n);
        glm::vec<n, float> v;
        for (int i = 0; i < n; ++i) v[i] = number(values[static_cast<std::size_t>(i)], what, min, max);
        return v;
    }
    /// Normalised; one of no length is an error.
    [[nodiscard]] glm::quat quaternion(glm::vec4 xyzw, const std::string& what) const;

    /// The extras object of an item; an empty object where there is none.
    template <class Item>
    static Json extras(const Item& item) {
        Json json = item.extras_json_string.empty() ? Json::object() : Json::parse(item.extras_json_string);
        return json.is_object() ? json : Json::object();
    }
    /// A member of an item's extension; null where it has none.
    template <class Item>
    static const tinygltf::Value* extension(const Item& item, const char* name, const char* key) {
        const auto found = item.extensions.find(name);
        return found != item.extensions.end() && found->second.Has(key) ? &found->second.Get(key) : nullptr;
    }

    /// The bytes of a buffer view from `offset` on.
    [[nodiscard]] std::span<const std::uint8_t> view_bytes(int view, std::size_t offset,
                                                           const std::string& what) const;
    /// All elements of an accessor of the given type (TINYGLTF_TYPE_*), components interleaved: double holds every
    /// index and every float. Normalised integers become 0..1 or -1..1; sparse elements are put in.
    [[nodiscard]] std::vector<double> read(int accessor, int type, const std::string& what) const;
    template <int n>
    std::vector<glm::vec<n, float>> read_vectors(int accessor, const std::string& what) const {
        const std::vector<double> values = read(accessor, n, what);  // TINYGLTF_TYPE_VECn is n
        std::vector<glm::vec<n, float>> vectors(values.size() / n);
        for (std::size_t i = 0; i < values.size(); ++i)
            vectors[i / n][static_cast<int>(i % n)] = static_cast<float>(values[i]);
        return vectors;
    }

  private:
    void check_extensions() const;
    void decompress_views();
    template <class Visit>
    void visit(int view, std::size_t offset, std::size_t count, std::size_t size, const std::string& what,
               Visit element) const;
    template <class Store>
    void replace_sparse(const tinygltf::Accessor& accessor, std::size_t size, const std::string& what,
                        Store store) const;

    std::filesystem::path path_;
    tinygltf::Model model_;
    std::map<int, std::vector<std::uint8_t>> decompressed_;  ///< what EXT_meshopt_compression has in buffer views
    mutable std::set<std::string> skipped_, doubts_;         ///< notes of what was read, not of the file
};

}  // namespace tyndall::gltf
