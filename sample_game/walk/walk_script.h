#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/scene/aabb.h"

namespace tyndall {

/// A walk through a level, as a file says it (assets/levels/README.md): dark lamps in several places, which a
/// player lights with a lantern. Metres, seconds. Words may name keys: with_keys().
struct WalkScript {
    struct View {
        glm::vec3 eye, look;  ///< look: a point
    };
    struct Fog {
        std::size_t medium;  ///< of the scene
        float before;        ///< what its coefficients are multiplied by, until the place is lit; then 1
    };
    struct Place {
        std::string name;
        glm::vec3 at;             ///< its first lamp: the one nearest to it in the scene
        float reach;              ///< from how far it is lit
        Aabb lamps;               ///< all that then burn, one after another
        std::vector<Fog> fog;     ///< that rises or falls
        std::string words, hint;  ///< once it is lit; of the way to it
    };
    struct Lantern {
        float candela, range;
        glm::vec3 color;
    };
    /// What the sun has become when all is lit.
    struct Night {
        float sun;        ///< share of its light
        glm::vec3 color;  ///< that its own is multiplied by
        float exposure;   ///< EV added
    };

    View title;
    std::string title_words;
    std::vector<std::string> beginning;
    Lantern lantern;
    Night night;
    float hint_after;  ///< without a lamp that was lit
    std::vector<Place> places;
    View end;
    std::vector<std::string> end_words;
};

/// Throws Error: `where` (a path), what, expected.
[[nodiscard]] WalkScript parse_walk(const nlohmann::json& json, const std::string& where);
[[nodiscard]] WalkScript load_walk(const std::filesystem::path& path);
/// Of the walk of a level: beside it, "abbey.walk.json" for "abbey.glb".
[[nodiscard]] std::filesystem::path walk_path(const std::filesystem::path& level);

}  // namespace tyndall
