#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace tyndall::test {

struct Lamp {
    glm::vec3 position;
    float candela = 50;
    float range = 5;  ///< m
    bool spot = false;
};

/// A small scene written as glTF: a grey 40 m floor at y = 0, a wall, a camera named `camera` at (0, 2, 10) looking
/// along -Z, and what is asked for.
struct SceneSpec {
    bool sun = false;
    std::vector<Lamp> lamps = {};
    std::string media = "[]";  ///< JSON list, as in extras.media
    bool floor = true;
    bool glass = false;  ///< a sheet above the floor that colours light
};
void write_scene(const std::filesystem::path& path, const SceneSpec& spec);

}  // namespace tyndall::test
