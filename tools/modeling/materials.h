// Materials of a glTF file, and what a mesh under construction knows about the one it uses.
#pragma once

#include <compare>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace tyndall::modeling {

// What a face is made of: an index into MaterialSet::materials, and the length of one texture tile in metres.
struct Surface {
    int material = 0;
    float tile_metres = 1.0f;

    friend bool operator==(const Surface& a, const Surface& b) { return a.material == b.material; }
    friend std::strong_ordering operator<=>(const Surface& a, const Surface& b) {
        return a.material <=> b.material;
    }
};

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
    float transmission = 0.0f;       // of light that crosses the surface, coloured as it
    bool mask = false, blend = false, double_sided = false;
};

struct MaterialSet {
    std::vector<Material> materials;
    std::vector<EncodedImage> images;
};

}  // namespace tyndall::modeling
