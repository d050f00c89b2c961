// Wood, plants, rock, cloth, metal, water, glass.
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

float streaks(vec2 uv, int across, int along, int octaves, uint32_t seed) {
    return fractal_noise(uv * vec2(across, along), ivec2(across, along), octaves, seed);
}

}  // namespace

Texel paint_timber(vec2 uv) {
    // 1 m tile, grain along v: rings seen as fine lines, a few drying cracks.
    const float bend = (streaks(uv, 4, 3, 3, 101) - 0.5f) * 0.10f;
    const float lines = streaks(glm::fract(uv + vec2(bend, 0)), 48, 2, 3, 102), broad = streaks(uv, 8, 2, 4, 103);
    const float crack = smooth_between(0.70f, 0.80f, streaks(glm::fract(uv + vec2(bend, 0)), 14, 2, 3, 104));
    Texel t;
    t.height = lines * 0.004f + broad * 0.006f - crack * 0.010f;
    t.color = glm::mix(vec3(0.22f, 0.155f, 0.105f), vec3(0.40f, 0.29f, 0.19f), lines * 0.6f + broad * 0.4f) *
              (1.0f - 0.55f * crack);
    t.roughness = 0.78f + 0.12f * lines;
    return t;
}

Texel paint_planks(vec2 uv) {
    // 1.2 m tile of six boards.
    const float x = uv.x * 6.0f, fx = x - std::floor(x);
    const auto id = hash(static_cast<uint32_t>(x) + 900U);
    const float offset = unit_float(id), edge = std::min(fx, 1.0f - fx) * 0.2f;
    const vec2 shifted = glm::fract(uv + vec2(0, offset));
    const float lines = streaks(shifted, 60, 2, 3, 111), broad = streaks(shifted, 12, 2, 3, 112);
    const float body = smooth_between(0.002f, 0.010f, edge);
    Texel t;
    t.height = body * 0.010f + lines * 0.003f + broad * 0.003f;
    const vec3 wood = glm::mix(vec3(0.33f, 0.25f, 0.17f), vec3(0.52f, 0.41f, 0.29f), lines * 0.5f + broad * 0.5f);
    t.color = wood * (0.78f + 0.35f * unit_float(hash(id))) * glm::mix(0.30f, 1.0f, body);
    t.roughness = 0.80f;
    return t;
}

Texel paint_grass(vec2 uv) {
    // 4 m tile seen from standing height: clumps, bare patches, straw.
    const float blades = noise(uv, 96, 3, 121), clump = noise(uv, 14, 4, 122),
                soil = smooth_between(0.56f, 0.72f, noise(uv, 5, 5, 123));
    const float straw = smooth_between(0.62f, 0.85f, noise(uv, 60, 3, 124));
    Texel t;
    t.height = blades * 0.05f * (1.0f - soil) + clump * 0.06f;
    vec3 grass = glm::mix(vec3(0.19f, 0.25f, 0.10f), vec3(0.42f, 0.44f, 0.19f), blades * 0.6f + clump * 0.4f);
    grass = glm::mix(grass, vec3(0.62f, 0.55f, 0.33f), straw * 0.5f);
    t.color = glm::mix(grass, vec3(0.36f, 0.29f, 0.21f) * (0.6f + 0.7f * blades), soil * 0.85f);
    t.roughness = 0.95f;
    return t;
}

Texel paint_rock(vec2 uv) {
    // 8 m tile of layered cliff.
    const vec2 warp = (vec2(noise(uv, 5, 4, 131), noise(uv, 5, 4, 132)) - 0.5f) * 0.12f;
    const float layers = streaks(glm::fract(uv + warp), 4, 18, 4, 133);
    const Cell c = cellular((uv + warp) * vec2(8, 12), {8, 12}, 0.95f, 134);
    const float crack = smooth_between(0.0f, 0.12f, c.second - c.first), grain = noise(uv, 64, 5, 135);
    Texel t;
    t.height = layers * 0.30f + crack * 0.10f + grain * 0.08f + unit_float(c.id) * 0.12f;
    vec3 rock = glm::mix(vec3(0.36f, 0.33f, 0.30f), vec3(0.56f, 0.49f, 0.41f), layers) * (0.70f + 0.5f * grain);
    rock *= glm::mix(0.62f, 1.0f, crack) * (0.85f + 0.25f * unit_float(c.id));
    t.color = glm::mix(rock, vec3(0.30f, 0.33f, 0.18f), smooth_between(0.55f, 0.75f, noise(uv, 7, 5, 136)) * 0.5f);
    t.roughness = 0.92f;
    return t;
}

Texel paint_bark(vec2 uv) {
    // 1.2 m tile: deep ridges running up.
    const vec2 warp((noise(uv, 6, 4, 141) - 0.5f) * 0.16f, 0.0f);
    const Cell c = cellular(glm::fract(uv + warp) * vec2(12, 4), {12, 4}, 0.95f, 142);
    const float ridge = smooth_between(0.02f, 0.35f, c.second - c.first), grain = streaks(uv, 48, 12, 4, 143);
    Texel t;
    t.height = ridge * 0.030f + grain * 0.012f;
    t.color = glm::mix(vec3(0.13f, 0.11f, 0.09f), vec3(0.40f, 0.33f, 0.26f), ridge * 0.7f + grain * 0.3f);
    t.color =
        glm::mix(t.color, vec3(0.30f, 0.33f, 0.18f), smooth_between(0.58f, 0.8f, noise(uv, 5, 4, 144)) * 0.5f);
    t.roughness = 0.95f;
    return t;
}

Texel paint_leaves(vec2 uv) {
    // A spray of leaves: each is a pointed ellipse at a hashed place, size and angle; the last drawn lies on top.
    Texel t;
    t.alpha = 0.0f;
    t.color = vec3(0.36f, 0.32f, 0.12f);
    Random random(151);
    for (int i = 0; i < 58; ++i) {
        const float radius = std::sqrt(random.unit()) * 0.42f, around = random.range(0.0f, 2.0f * kPi);
        const vec2 centre = vec2(0.5f) + radius * vec2(cosine(around), sine(around));
        const float angle = around + random.range(-1.0f, 1.0f), length = random.range(0.075f, 0.12f);
        const float shade = random.unit(), autumn = random.unit();
        const vec2 d = uv - centre, axis(cosine(angle), sine(angle));
        const float x = glm::dot(d, axis) / length, y = glm::dot(d, vec2(-axis.y, axis.x)) / length;
        const float half = 0.46f * (1.0f - x * x) * (1.0f - 0.25f * x);
        if (std::abs(x) < 1.0f && std::abs(y) < half) {
            vec3 leaf = glm::mix(vec3(0.27f, 0.34f, 0.11f), vec3(0.52f, 0.50f, 0.16f), shade);
            leaf = glm::mix(leaf, vec3(0.74f, 0.45f, 0.13f), autumn > 0.55f ? (autumn - 0.55f) * 1.9f : 0.0f);
            const float rib = std::abs(y) < 0.05f ? 1.22f : 1.0f;
            t.color = leaf * rib * (0.85f + 0.3f * std::abs(y) / std::max(half, 0.01f));
            t.alpha = 1.0f;
        }
    }
    t.roughness = 0.65f;
    return t;
}

Texel paint_iron(vec2 uv) {
    const float rust = smooth_between(0.5f, 0.75f, noise(uv, 10, 5, 161)), hammer = noise(uv, 20, 3, 162);
    Texel t;
    t.height = hammer * 0.002f + rust * 0.001f;
    t.color = glm::mix(vec3(0.30f, 0.30f, 0.31f), vec3(0.36f, 0.22f, 0.14f), rust);
    t.roughness = glm::mix(0.45f, 0.85f, rust);
    t.metallic = glm::mix(0.9f, 0.15f, rust);
    return t;
}

Texel paint_cloth(vec2 uv) {
    // 0.5 m tile of coarse weave, near white: the material's factor dyes it.
    const float warp = sine(uv.x * 2.0f * kPi * 64.0f), weft = sine(uv.y * 2.0f * kPi * 64.0f);
    const float slub = streaks(uv, 40, 6, 3, 171), worn = noise(uv, 4, 4, 172);
    Texel t;
    t.height = (warp * weft) * 0.0006f + slub * 0.0015f;
    t.color = vec3(0.80f + 0.10f * warp * weft) * (0.75f + 0.3f * slub) * (0.8f + 0.25f * worn);
    t.roughness = 0.95f;
    return t;
}

Texel paint_water(vec2 uv) {
    Texel t;
    t.height = noise(uv, 6, 4, 181) * 0.05f;
    t.color = vec3(0.06f, 0.09f, 0.09f);
    t.roughness = 0.06f;
    return t;
}

Texel paint_window(vec2 uv) {
    // Leaded quarries, 0.8 m tile of 5 x 5 diamonds: as albedo dark, as emission the lit room behind.
    const vec2 d = vec2(uv.x + uv.y, uv.x - uv.y) * 5.0f, f = glm::fract(d);
    const float lead = std::min(std::min(f.x, 1.0f - f.x), std::min(f.y, 1.0f - f.y));
    const ivec2 cell = (ivec2(glm::floor(d)) % 5 + 5) % 5;
    const float glow = 0.55f + 0.45f * hash_float(cell.x, cell.y, 191);
    Texel t;
    const float glass = smooth_between(0.04f, 0.09f, lead);
    t.height = (1.0f - glass) * 0.006f;
    t.color =
        glm::mix(vec3(0.05f), glm::mix(vec3(0.85f, 0.50f, 0.20f), vec3(1.0f, 0.76f, 0.40f), glow) * glow, glass);
    t.roughness = glm::mix(0.7f, 0.15f, glass);
    return t;
}

}  // namespace tyndall::level
