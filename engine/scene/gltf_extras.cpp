#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string_view>

#include "engine/scene/gltf_parts.h"

namespace tyndall::gltf {
namespace {

/// What has extras, and the names among them that are read.
struct Owner {
    std::string_view name;
    std::vector<std::string_view> read;
};
const Owner of_scene{"scene", {"exposure", "media"}};
const Owner of_node{"node", {"cast_shadow", "draw_distance", "medium", "particles"}};
const Owner of_light{"light", {"radius", "shadow"}};
const Owner of_animation{"animation", {"places"}};
const Owner of_mesh{"mesh", {"targetNames"}};  // names of morph targets, which are told elsewhere
const Owner of_material{"material", {}};
const Owner of_camera{"camera", {}};

/// Small letters and digits alone: "Cast Shadow" and "castShadow" are "castshadow".
std::string plain(std::string_view key) {
    std::string text;
    for (const char c : key)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Levenshtein's distance: letters put in, left out or replaced.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j)
            diagonal = std::exchange(row[j + 1], std::min({diagonal + (a[i] != b[j]), row[j] + 1, row[j + 1] + 1}));
    }
    return row.back();
}

/// What was probably meant by a name that is not read of its owner; empty: nothing that is known here.
std::string meant(std::string_view key, const Owner& owner) {
    const std::string given = plain(key);
    for (const std::string_view known : owner.read)
        if (given.size() > 3 && distance(given, plain(known)) <= given.size() / 4)
            return fmt::format("\"{}\" meant?", known);
    constexpr std::string_view fogs[] = {"fog",        "mist",        "haze",   "smoke", "volume",
                                         "volumetric", "volumetrics", "medium", "media"};
    if (std::ranges::find(fogs, given) != std::end(fogs))
        return &owner == &of_scene  ? "\"media\" meant?"
               : &owner == &of_node ? "\"medium\" meant, or \"media\" of the scene?"
                                    : "\"medium\" of a node meant, or \"media\" of the scene?";
    for (const Owner* other : {&of_scene, &of_node, &of_light, &of_animation})
        for (const std::string_view known : other->read)
            if (given == plain(known)) return fmt::format("\"{}\" is read of a {}", known, other->name);
    return {};
}

}  // namespace

void tell_ignored_extras(const GltfFile& file) {
    std::vector<std::string> ignored;
    const auto look = [&](const auto& items, const Owner& owner) {
        for (const auto& item : items) {
            const Json extra = file.extras(item);
            for (const auto& [key, value] : extra.items()) {
                if (std::ranges::find(owner.read, key) != owner.read.end()) continue;
                const std::string name = fmt::format("{} of a {}", Json(key).dump(), owner.name);
                if (const std::string other = meant(key, owner); !other.empty())
                    file.doubt("extras: {} is not read: {}", name, other);
                else if (std::ranges::find(ignored, name) == ignored.end())
                    ignored.push_back(name);
            }
        }
    };
    const tinygltf::Model& model = file.model();
    look(model.scenes, of_scene);
    look(model.nodes, of_node);
    look(model.lights, of_light);
    look(model.animations, of_animation);
    look(model.meshes, of_mesh);
    look(model.materials, of_material);
    look(model.cameras, of_camera);
    if (!ignored.empty()) file.skip("extras ignored: {}", fmt::join(ignored, ", "));
}

}  // namespace tyndall::gltf
