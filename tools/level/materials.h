// The level's materials: names, texel density and the textures painted for them.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace tyndall::level {

enum class Mat {
    Ashlar,
    Trim,
    Rubble,
    Flags,
    Cobbles,
    Plaster,
    Timber,
    Planks,
    Slate,
    Clay,
    Grass,
    Rock,
    Hills,
    Bark,
    Leaves,
    Iron,
    ClothRed,
    ClothBlue,
    ClothOchre,
    Lantern,
    Paper,
    Window,
    Water,
    Count
};
constexpr int kMaterialCount = static_cast<int>(Mat::Count);

// Length of one texture tile in metres.
float tile_metres(Mat mat);

struct EncodedImage {
    std::string name, mime;
    std::vector<unsigned char> bytes;
};

// Indices into MaterialSet::images, -1: none. Colours are linear.
struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};
    float metallic = 0.0f, roughness = 1.0f;
    int albedo = -1, normal = -1, surface = -1;  // surface: occlusion, roughness, metallic in r, g, b
    glm::vec3 emissive{0.0f};
    float emissive_strength = 0.0f;  // cd/m^2 for emissive 1
    bool glow_from_albedo = false;   // the albedo texture also modulates the emission
    bool mask = false, double_sided = false;
};

struct MaterialSet {
    std::vector<Material> materials;  // in the order of Mat
    std::vector<EncodedImage> images;
};

MaterialSet make_materials();

}  // namespace tyndall::level
