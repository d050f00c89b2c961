#include "engine/render/sky_directions.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/core/check.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/cube_direction.glsl"
TYNDALL_GLSL_END

namespace tyndall {
namespace {

struct Texel {
    glm::vec3 direction;
    glm::vec3 light;  ///< radiance times its share of the sphere
    float share;
    bool new_face;
};

/// Every second bit of `index`: place on the Morton curve.
int even_bits(int index) {
    int bits = 0;
    for (int bit = 0; bit < 15; ++bit) bits |= (index >> (2 * bit) & 1) << bit;
    return bits;
}

/// Neighbours along a curve through each face lie beside each other in the sky.
std::vector<Texel> along_curve(std::span<const glm::vec4> cube, int size) {
    std::vector<Texel> texels;
    double whole = 0;
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < size * size; ++i) {
            const int x = even_bits(i), y = even_bits(i >> 1);
            const glm::vec3 axis = glsl::cube_axis_direction({x, y, face}, size);
            // A texel at the distance r from the cube's centre covers (2 / size)² / r³.
            const float r2 = glm::dot(axis, axis), r = std::sqrt(r2), share = 1 / (r2 * r);
            const int texel = (face * size + y) * size + x;
            texels.push_back({axis / r, share * glm::vec3(cube[static_cast<std::size_t>(texel)]), share, i == 0});
            whole += double{share};
        }
    for (Texel& t : texels) {
        t.light /= static_cast<float>(whole);
        t.share /= static_cast<float>(whole);
    }
    return texels;
}

float all_channels(glm::vec3 v) {
    return v.x + v.y + v.z;
}

void add(SkyPart& part, const Texel& texel, glm::vec3& middle) {
    for (int c = 0; c < 3; ++c)
        part.light[static_cast<std::size_t>(c)] += texel.light[c] * glm::vec4(1, 3.0f * texel.direction);
    middle += (all_channels(texel.light) + 1e-20f) * texel.direction;
}

/// Every stride-th, around and around: so any first ones lie all over.
std::vector<SkyPart> shuffled(const std::vector<SkyPart>& parts) {
    const std::size_t count = parts.size();
    auto stride = static_cast<std::size_t>(static_cast<double>(count) / std::numbers::phi);
    while (std::gcd(stride, count) != 1) ++stride;
    std::vector<SkyPart> order;
    for (std::size_t k = 0; k < count; ++k) order.push_back(parts[k * stride % count]);
    return order;
}

}  // namespace

std::vector<SkyPart> share_sky(std::span<const glm::vec4> cube, int size, int count) {
    constexpr int faces = 6;
    TYNDALL_CHECK_EQ(cube.size(), static_cast<std::size_t>(faces * size * size));
    TYNDALL_CHECK_LT(faces, count);
    const std::vector<Texel> texels = along_curve(cube, size);
    double light = 0;
    for (const Texel& t : texels) light += double{all_channels(t.light)};
    const auto weight = [&](const Texel& t) {
        const double above = t.direction.y > 0 ? 2 * double{t.share} : 0;
        return 0.25 * above + (light > 0 ? 0.75 * double{all_channels(t.light)} / light : 0);
    };
    std::vector<SkyPart> parts;
    glm::vec3 middle(0);
    double done = 0, part_end = 0;
    const int whole_parts = count - faces;  // each face may end with one that is not full
    for (const Texel& t : texels) {
        if (t.new_face || done >= part_end) {
            parts.emplace_back();
            middle = glm::vec3(0);
            part_end = done + 1.0 / whole_parts;
        }
        add(parts.back(), t, middle);
        parts.back().direction = glm::normalize(middle);
        done += weight(t);
    }
    TYNDALL_CHECK_LE(parts.size(), static_cast<std::size_t>(count));
    parts.resize(static_cast<std::size_t>(count));
    return shuffled(parts);
}

SkyLight sum_of_light(std::span<const SkyPart> parts) {
    SkyLight all{};
    for (const SkyPart& part : parts)
        for (std::size_t c = 0; c < all.size(); ++c) all[c] += part.light[c];
    return all;
}

}  // namespace tyndall
