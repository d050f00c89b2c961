// Cut and broken stone, plaster, and what roofs are covered with.
#include <algorithm>

#include "tools/level/texture.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

using glm::ivec2;
using glm::vec2;
using glm::vec3;

namespace {

float noise(vec2 uv, int cells, int octaves, uint32_t seed) {
    return fractal_noise(uv * static_cast<float>(cells), ivec2(cells), octaves, seed);
}

float tint(uint32_t id, uint32_t salt) {
    return unit_float(hash(id + salt));
}

}  // namespace

Texel paint_ashlar(const Masonry& blocks, vec2 uv) {
    // 2.4 m tile of warm limestone in courses of 0.3 to 0.5 m.
    const vec2 wobble = (vec2(noise(uv, 16, 3, 11), noise(uv, 16, 3, 12)) - 0.5f) * 0.008f;
    const auto b = blocks.at(glm::fract(uv + wobble));
    const float edge = std::min(b.edge.x, b.edge.y) * 2.4f;  // metres
    const float body = smooth_between(0.004f, 0.028f, edge), grain = noise(uv, 64, 4, 13),
                pits = noise(uv, 24, 4, 14);
    const float pit = smooth_between(0.62f, 0.78f, pits);
    Texel t;
    t.height = body * 0.022f + grain * 0.006f - pit * 0.010f + tint(b.id, 1) * 0.008f * body +
               (tint(b.id, 2) - 0.5f) * (b.local.x - 0.5f) * 0.012f * body;
    vec3 stone = glm::mix(vec3(0.60f, 0.53f, 0.43f), vec3(0.72f, 0.65f, 0.53f), tint(b.id, 3));
    stone = glm::mix(stone, vec3(0.56f, 0.53f, 0.48f), tint(b.id, 4) * 0.55f);
    stone *= 0.82f + 0.30f * grain;
    stone *= 1.0f - 0.30f * pit;
    const float stain = smooth_between(0.48f, 0.75f, noise(uv, 5, 4, 15));
    stone = glm::mix(stone, vec3(0.36f, 0.34f, 0.27f), stain * 0.45f);
    const float moss = smooth_between(0.60f, 0.80f, noise(uv, 7, 5, 16) + (1.0f - body) * 0.10f);
    stone = glm::mix(stone, vec3(0.30f, 0.34f, 0.17f), moss * 0.55f);
    t.color = glm::mix(vec3(0.44f, 0.40f, 0.33f), stone, body);
    t.roughness = 0.86f + 0.10f * grain;
    return t;
}

Texel paint_flags(const Masonry& blocks, vec2 uv) {
    // 3 m tile of worn paving, polished where people walk.
    const auto b = blocks.at(uv);
    const float edge = std::min(b.edge.x, b.edge.y) * 3.0f;
    const float body = smooth_between(0.004f, 0.03f, edge), grain = noise(uv, 72, 4, 21),
                wear = noise(uv, 6, 4, 22);
    Texel t;
    t.height =
        body * 0.016f + grain * 0.003f + tint(b.id, 1) * 0.006f * body - smooth_between(0.55f, 0.8f, wear) * 0.004f;
    vec3 stone = glm::mix(vec3(0.42f, 0.40f, 0.37f), vec3(0.58f, 0.53f, 0.45f), tint(b.id, 2));
    stone *= 0.80f + 0.34f * grain;
    stone = glm::mix(stone, vec3(0.33f, 0.31f, 0.27f), smooth_between(0.5f, 0.75f, noise(uv, 9, 4, 23)) * 0.4f);
    t.color = glm::mix(vec3(0.24f, 0.23f, 0.17f), stone, body);
    t.roughness = glm::mix(0.9f, 0.48f + 0.3f * wear, body);
    return t;
}

Texel paint_trim(vec2 uv) {
    // 1.5 m tile of dressed stone: tool marks, a few veins.
    const float grain = noise(uv, 48, 4, 31), cloud = noise(uv, 6, 4, 32);
    const float tooling = value_noise(vec2(uv.x * 96.0f, uv.y * 8.0f), ivec2(96, 8), 34);
    Texel t;
    t.height = grain * 0.004f + tooling * 0.0015f - smooth_between(0.66f, 0.8f, noise(uv, 20, 3, 35)) * 0.004f;
    vec3 stone = glm::mix(vec3(0.66f, 0.59f, 0.48f), vec3(0.76f, 0.70f, 0.59f), cloud) * (0.86f + 0.24f * grain);
    stone = glm::mix(stone, vec3(0.40f, 0.38f, 0.30f), smooth_between(0.52f, 0.8f, noise(uv, 4, 5, 36)) * 0.45f);
    t.color = stone;
    t.roughness = 0.80f + 0.15f * grain;
    return t;
}

Texel paint_rubble(vec2 uv) {
    // 2 m tile of field stones in lime mortar, wider than high.
    const vec2 warp = (vec2(noise(uv, 8, 3, 41), noise(uv, 8, 3, 42)) - 0.5f) * 0.05f;
    const Cell c = cellular((uv + warp) * vec2(6, 11), {6, 11}, 0.85f, 43);
    const float gap = c.second - c.first, body = smooth_between(0.05f, 0.24f, gap), grain = noise(uv, 64, 4, 44);
    Texel t;
    t.height = body * 0.03f + grain * 0.008f + tint(c.id, 1) * 0.012f * body;
    vec3 stone = glm::mix(vec3(0.40f, 0.37f, 0.33f), vec3(0.60f, 0.52f, 0.41f), tint(c.id, 2));
    stone = glm::mix(stone, vec3(0.45f, 0.45f, 0.46f), tint(c.id, 3) * 0.6f) * (0.75f + 0.42f * grain);
    t.color = glm::mix(vec3(0.55f, 0.50f, 0.42f) * (0.75f + 0.35f * grain), stone, body);
    t.color = glm::mix(t.color, vec3(0.29f, 0.32f, 0.18f), smooth_between(0.58f, 0.8f, noise(uv, 5, 5, 45)) * 0.5f);
    t.roughness = 0.92f;
    return t;
}

Texel paint_cobbles(vec2 uv) {
    // 2 m tile of rounded setts, damp between.
    const Cell c = cellular(uv * vec2(14, 14), {14, 14}, 0.55f, 51);
    const float body = smooth_between(0.03f, 0.35f, c.second - c.first), grain = noise(uv, 64, 3, 52);
    const float damp = smooth_between(0.45f, 0.70f, noise(uv, 4, 4, 53));
    Texel t;
    t.height = body * 0.022f + tint(c.id, 1) * 0.006f * body + grain * 0.002f +
               glm::dot(c.offset, vec2(tint(c.id, 5) - 0.5f, tint(c.id, 6) - 0.5f)) * 0.010f * body;
    vec3 stone =
        glm::mix(vec3(0.35f, 0.34f, 0.34f), vec3(0.52f, 0.47f, 0.41f), tint(c.id, 2)) * (0.78f + 0.4f * grain);
    t.color = glm::mix(vec3(0.17f, 0.16f, 0.13f), stone, body) * glm::mix(1.0f, 0.74f, damp);
    t.roughness = glm::mix(glm::mix(0.85f, 0.62f, body), 0.34f, damp * 0.8f);
    return t;
}

Texel paint_plaster(vec2 uv) {
    // 3 m tile of old limewash, stained downwards.
    const float grain = noise(uv, 48, 4, 61), cloud = noise(uv, 5, 5, 62);
    const float runs = fractal_noise(uv * vec2(24, 3), {24, 3}, 4, 63),
                loss = smooth_between(0.64f, 0.70f, noise(uv, 5, 5, 64));
    Texel t;
    t.height = grain * 0.004f + cloud * 0.012f - loss * 0.012f;
    vec3 wash = glm::mix(vec3(0.77f, 0.70f, 0.57f), vec3(0.86f, 0.80f, 0.68f), cloud);
    wash = glm::mix(wash, vec3(0.52f, 0.44f, 0.33f), smooth_between(0.5f, 0.8f, runs) * 0.55f);
    t.color = glm::mix(wash, vec3(0.52f, 0.45f, 0.36f) * (0.7f + 0.5f * grain), loss) * (0.92f + 0.14f * grain);
    t.roughness = 0.93f;
    return t;
}

Texel paint_slate(vec2 uv) {
    // 2 m tile, 10 courses: each slate lies on the one below, so height grows towards its lower edge.
    const float row = std::floor(uv.y * 10.0f), x = uv.x * 8.0f + (static_cast<int>(row) % 2 ? 0.5f : 0.0f);
    const float y = uv.y * 10.0f - row;
    const auto id =
        hash(static_cast<uint32_t>(row) * 64U + static_cast<uint32_t>(static_cast<int>(std::floor(x)) % 8));
    const float fx = x - std::floor(x), side = std::min(fx, 1.0f - fx) * 0.25f;
    const float ragged = 0.93f + 0.06f * tint(id, 4) + (noise(uv, 40, 3, 71) - 0.5f) * 0.04f;
    const float below = y > ragged ? 1.0f : 0.0f, gap = smooth_between(0.002f, 0.008f, side),
                grain = noise(uv, 56, 4, 72);
    Texel t;
    t.height = (below > 0.5f ? 0.0f : y * 0.020f * gap) + grain * 0.003f + (tint(id, 1) - 0.5f) * 0.006f;
    vec3 slate = glm::mix(vec3(0.27f, 0.30f, 0.34f), vec3(0.40f, 0.39f, 0.41f), tint(id, 2));
    slate = glm::mix(slate, vec3(0.37f, 0.31f, 0.28f), tint(id, 3) > 0.8f ? 0.6f : 0.0f) * (0.75f + 0.45f * grain);
    slate = glm::mix(slate, vec3(0.38f, 0.38f, 0.22f), smooth_between(0.62f, 0.8f, noise(uv, 8, 5, 73)) * 0.6f);
    t.color = slate * (below > 0.5f ? 0.45f : 1.0f) * glm::mix(0.5f, 1.0f, gap);
    t.roughness = 0.50f + 0.25f * grain;
    return t;
}

Texel paint_clay(vec2 uv) {
    // 2 m tile, 8 courses of 10 barrel tiles.
    const float row = std::floor(uv.y * 8.0f), x = uv.x * 10.0f, y = uv.y * 8.0f - row;
    const auto id = hash(static_cast<uint32_t>(row) * 64U + static_cast<uint32_t>(x));
    const float fx = x - std::floor(x), across = (fx - 0.5f) * 2.0f, grain = noise(uv, 56, 4, 81);
    const float barrel = std::sqrt(std::max(0.0f, 1.0f - across * across * 0.96f));
    const float lip = smooth_between(1.0f, 0.94f, y);
    Texel t;
    t.height = barrel * 0.045f + y * 0.012f * lip + grain * 0.003f;
    vec3 clay = glm::mix(vec3(0.55f, 0.30f, 0.20f), vec3(0.70f, 0.43f, 0.28f), tint(id, 2));
    clay = glm::mix(clay, vec3(0.42f, 0.30f, 0.25f), tint(id, 3) * 0.6f) * (0.75f + 0.4f * grain);
    clay = glm::mix(clay, vec3(0.42f, 0.41f, 0.28f), smooth_between(0.56f, 0.8f, noise(uv, 6, 5, 83)) * 0.65f);
    t.color = clay * glm::mix(0.45f, 1.0f, smooth_between(0.05f, 0.4f, barrel)) * glm::mix(0.55f, 1.0f, lip);
    t.roughness = 0.82f;
    return t;
}

}  // namespace tyndall::level
