// Tileable procedural textures: a painter gives one texel, the rest (normals, occlusion, encoding) is common.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "tools/level/materials.h"

namespace tyndall::level {

struct Texel {
    glm::vec3 color{0.5f};  // sRGB, [0,1]
    float height = 0.0f;    // metres
    float roughness = 0.9f;
    float metallic = 0.0f;
    float alpha = 1.0f;
};

// uv in [0,1): u right, v down, as glTF addresses images.
using Painter = std::function<Texel(glm::vec2 uv)>;

struct Painted {
    int size;
    std::vector<Texel> texels;
};
Painted paint(int size, const Painter& painter);

EncodedImage encode_albedo(const Painted& painted, const std::string& name, int quality);
EncodedImage encode_albedo_alpha(const Painted& painted,
                                 const std::string& name);  // PNG, colours bled under alpha 0
EncodedImage encode_normal(const Painted& painted, const std::string& name, float tile_metres, int quality);
// Occlusion (from how deep a texel lies below its surroundings), roughness, metallic.
EncodedImage encode_surface(const Painted& painted, const std::string& name, int quality);

// Nearest and second nearest feature point of a jittered, repeating grid. Distances are in cells.
struct Cell {
    float first, second;
    uint32_t id;
    glm::vec2 offset;  // from the nearest feature point
};
Cell cellular(glm::vec2 p, glm::ivec2 period, float jitter, uint32_t seed);

// Courses of blocks in running bond; all cuts and course heights vary.
class Masonry {
  public:
    Masonry(int courses, int blocks, float unevenness, uint32_t seed);
    struct Block {
        uint32_t id;
        glm::vec2 edge;   // distance to the nearest vertical and horizontal joint, in tiles
        glm::vec2 local;  // position in the block, [0,1]
    };
    [[nodiscard]] Block at(glm::vec2 uv) const;

  private:
    std::vector<float> course_;             // lower edges, growing from 0
    std::vector<std::vector<float>> cuts_;  // joints in each course, growing, in [0,1)
};

// Painters, one per look.
Texel paint_ashlar(const Masonry& blocks, glm::vec2 uv);
Texel paint_flags(const Masonry& blocks, glm::vec2 uv);
Texel paint_trim(glm::vec2 uv);
Texel paint_rubble(glm::vec2 uv);
Texel paint_cobbles(glm::vec2 uv);
Texel paint_plaster(glm::vec2 uv);
Texel paint_slate(glm::vec2 uv);
Texel paint_clay(glm::vec2 uv);
Texel paint_timber(glm::vec2 uv);
Texel paint_planks(glm::vec2 uv);
Texel paint_grass(glm::vec2 uv);
Texel paint_rock(glm::vec2 uv);
Texel paint_bark(glm::vec2 uv);
Texel paint_leaves(glm::vec2 uv);
Texel paint_iron(glm::vec2 uv);
Texel paint_cloth(glm::vec2 uv);
Texel paint_water(glm::vec2 uv);
Texel paint_window(glm::vec2 uv);
// Four windows side by side, each with its main colour: see StainedGlass.
Texel paint_stained_glass(glm::vec2 uv);

// Shared colour helpers.
inline float smooth_between(float a, float b, float x) {
    const float t = glm::clamp((x - a) / (b - a), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

}  // namespace tyndall::level
