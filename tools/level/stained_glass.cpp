#include "tools/level/stained_glass.h"

#include <algorithm>

#include "tools/level/texture.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

namespace {

constexpr int kColours = 4;
constexpr float kDrawDistance = 60.0f;

float between(const std::vector<float>& us, const std::vector<float>& values, float u) {
    const auto next = static_cast<size_t>(std::ranges::lower_bound(us, u) - us.begin());
    if (next == 0) return values.front();
    if (next == us.size()) return values.back();
    const float share = (u - us[next - 1]) / (us[next] - us[next - 1]);
    return glm::mix(values[next - 1], values[next], share);
}

// Metres in a window of 2.5 m by 4.5 m, from its middle and its sill.
constexpr float kHalf = 1.25f, kHeight = 4.5f, kBorder = 0.24f, kLead = 0.03f;

struct Piece {
    int colour;  // as StainedGlass; kColours: pale gold
    float to_lead;
    uint32_t id;
};

Piece border(float x, float y, int main) {
    const float along = y / 0.3f, place = along - std::floor(along);
    const int row = static_cast<int>(along);
    const float edge = std::min(place, 1.0f - place) * 0.3f;
    return {row % 3 == 0 ? kColours : (main + 1) % kColours,
            std::min({edge, std::abs(x) - (kHalf - kBorder), kHalf - std::abs(x)}), static_cast<uint32_t>(row)};
}

// `p`: from its middle.
Piece medallion(vec2 p, float radius, int main) {
    const float r = glm::length(p), inner = 0.45f * radius;
    if (r < inner) return {kColours, inner - r, 7};
    float lead = std::min(r - inner, radius - r);
    for (const vec2 axis : {vec2(1, 0), vec2(0, 1), vec2(0.70711f, 0.70711f), vec2(0.70711f, -0.70711f)})
        lead = std::min(lead, std::abs(glm::dot(p, axis)));
    return {(main + 2) % kColours, lead, 11};
}

Piece quarry(float x, float y, int main) {
    constexpr float side = 0.30f;
    const vec2 d = vec2(x + y, x - y) / (1.41421f * side), f = glm::fract(d);
    const glm::ivec2 cell(glm::floor(d));
    const uint32_t id = hash(static_cast<uint32_t>(cell.x + 64) * 131u + static_cast<uint32_t>(cell.y + 64));
    return {id % 9u == 0u ? kColours : main, std::min({f.x, 1.0f - f.x, f.y, 1.0f - f.y}) * side, id};
}

}  // namespace

Texel paint_stained_glass(vec2 uv) {
    constexpr vec3 colours[] = {{0.86f, 0.06f, 0.07f},
                                {0.10f, 0.24f, 0.92f},
                                {0.08f, 0.66f, 0.24f},
                                {1.00f, 0.62f, 0.10f},
                                {1.00f, 0.88f, 0.62f}};
    const float column = uv.x * kColours;
    const int main = std::min(static_cast<int>(column), kColours - 1);
    const float x = (column - static_cast<float>(main) - 0.5f) * 2.0f * kHalf, y = (1.0f - uv.y) * kHeight;
    Piece piece = quarry(x, y, main);
    for (const float middle : {0.85f, 2.2f, 3.55f}) {
        constexpr float radius = 0.62f;
        const vec2 p(x, y - middle);
        const float outside = glm::length(p) - radius;
        if (outside < 0.0f)
            piece = medallion(p, radius, main);
        else
            piece.to_lead = std::min(piece.to_lead, outside);
    }
    if (std::abs(x) > kHalf - kBorder)
        piece = border(x, y, main);
    else
        piece.to_lead = std::min(piece.to_lead, kHalf - kBorder - std::abs(x));
    Texel t;
    const float glass = smooth_between(0.4f * kLead, 0.8f * kLead, piece.to_lead);
    t.color = colours[piece.colour] * (0.8f + 0.2f * unit_float(hash(piece.id + 17u))) * glass;
    return t;
}

Mesh stained_window(const std::string& name, const Wall& w, const Opening& o,
                    std::span<const StainedGlass> lights) {
    Mesh m{name, {}, mat4(1.0f)};
    const float left = o.us.front(), width = (o.us.back() - left) / static_cast<float>(lights.size());
    const float low = *std::ranges::min_element(o.lower), high = *std::ranges::max_element(o.upper);
    for (size_t light = 0; light < lights.size(); ++light) {
        const float begin = left + width * static_cast<float>(light), end = begin + width;
        std::vector<float> us{begin};
        for (const float u : o.us)
            if (u > begin + 1e-3f && u < end - 1e-3f) us.push_back(u);
        us.push_back(end);
        const auto uv = [&](float u, float y) {
            const float column = static_cast<float>(lights[light]) + 0.01f + 0.98f * (u - begin) / width;
            return vec2(column / kColours, 1.0f - (y - low) / (high - low));
        };
        for (size_t i = 0; i + 1 < us.size(); ++i) {
            const float a = us[i], b = us[i + 1];
            const vec2 bottom(between(o.us, o.lower, a), between(o.us, o.lower, b)),
                top(between(o.us, o.upper, a), between(o.us, o.upper, b));
            m.quad_uv(Mat::Stained,
                      {wall_point(w, a, bottom.x), wall_point(w, b, bottom.y), wall_point(w, b, top.y),
                       wall_point(w, a, top.x)},
                      {uv(a, bottom.x), uv(b, bottom.y), uv(b, top.y), uv(a, top.x)});
        }
    }
    return m;
}

void add_stained_window(Level& level, int mesh, vec3 position, float yaw_degrees) {
    const int node = level.add_instance("stained_glass", mesh, position, yaw_degrees);
    level.nodes[static_cast<size_t>(node)].extras["draw_distance"] = kDrawDistance;
}

}  // namespace tyndall::level
