#include "media/froxel_tiles.h"

#include <algorithm>
#include <limits>

#include "media/shape.h"

namespace tyndall::volumetrics {

ViewBounds view_bounds(const std::array<glm::vec3, 8>& corners, const Inputs& inputs) {
    ViewBounds bounds;
    for (const glm::vec3 corner : corners) {
        const glm::vec4 view = inputs.view * glm::vec4(corner, 1);
        const float depth = -view.z;
        bounds.nearest = std::min(bounds.nearest, depth);
        bounds.farthest = std::max(bounds.farthest, depth);
        if (depth <= 0) continue;
        const glm::vec4 clip = inputs.projection * view;
        const glm::vec2 uv = 0.5F * glm::vec2(clip) / clip.w + 0.5F;
        bounds.lower = glm::min(bounds.lower, uv);
        bounds.upper = glm::max(bounds.upper, uv);
    }
    if (bounds.nearest <= 0) {  // reaches behind the eye: its outline has no bounds
        bounds.lower = glm::vec2(0);
        bounds.upper = glm::vec2(1);
    }
    return bounds;
}

ViewBounds view_bounds(const LocalMedium& medium, const Inputs& inputs) {
    return view_bounds(corners(medium), inputs);
}

std::vector<glm::vec2> transparent_depths(const Inputs& inputs, glm::ivec2 columns) {
    std::vector<glm::vec2> depths(static_cast<std::size_t>(columns.x) * columns.y,
                                  {std::numeric_limits<float>::infinity(), 0});
    for (const Box& box : inputs.transparents) {
        std::array<glm::vec3, 8> corners;
        for (std::size_t i = 0; i < 8; ++i)
            corners[i] = glm::mix(box.min, box.max, glm::bvec3(i & 1, i & 2, i & 4));
        const ViewBounds bounds = view_bounds(corners, inputs);
        if (!bounds.in_view()) continue;
        // Pixels look into the four columns round them. A hair farther: rounding never loses a fragment.
        const glm::vec2 count = columns, depth{bounds.nearest * 0.999F, bounds.farthest * 1.001F};
        const glm::ivec2 first = glm::floor(glm::clamp(bounds.lower * count - 1.0F, glm::vec2(0), count));
        const glm::ivec2 end = glm::ceil(glm::clamp(bounds.upper * count + 1.0F, glm::vec2(0), count));
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) {
                glm::vec2& d = depths[static_cast<std::size_t>(y) * columns.x + x];
                d = {std::min(d.x, depth.x), std::max(d.y, depth.y)};
            }
    }
    return depths;
}

bool ViewBounds::in_view() const {
    return farthest > 0 && glm::all(glm::lessThan(lower, glm::vec2(1))) &&
           glm::all(glm::greaterThan(upper, glm::vec2(0)));
}

bool may_matter(const LocalMedium& medium, const Inputs& inputs) {
    const auto reaches = [&](const Lamp& lamp) {
        return lamp.range <= 0 || distances(medium, lamp.position).x < lamp.range;
    };
    if (inputs.has_lamps && std::ranges::any_of(inputs.lamps, reaches)) return true;
    const glm::mat4 rows = glm::transpose(inputs.projection * inputs.view);
    const std::array<glm::vec3, 8> box = corners(medium);
    // Beyond one of the planes of the view, and the sun's light does not bring its shadow back.
    for (const glm::vec4 plane :
         {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] - rows[2]}) {
        const auto beyond = [&](glm::vec3 corner) { return glm::dot(plane, glm::vec4(corner, 1)) < 0; };
        const bool recedes = !inputs.has_sun || glm::dot(glm::vec3(plane), inputs.sun_direction) <= 0;
        if (recedes && std::ranges::all_of(box, beyond)) return false;
    }
    return true;
}

IndexBox froxel_bounds(const ViewBounds& bounds, const FroxelGrid& grid) {
    if (!bounds.in_view() || bounds.nearest >= grid.farthest) return {};
    const auto w = [&](float depth) { return grid.w(std::max(depth, 0.0F)); };
    // A froxel more all round: rounding never loses one.
    const glm::vec3 size = grid.size;
    const glm::vec3 lower = glm::clamp(glm::vec3(bounds.lower, w(bounds.nearest)), -1.0F, 2.0F) * size - 1.0F;
    const glm::vec3 upper = glm::clamp(glm::vec3(bounds.upper, w(bounds.farthest)), -1.0F, 2.0F) * size + 1.0F;
    IndexBox box{.lower = glm::max(glm::ivec3(glm::floor(lower)), 0),
                 .upper = glm::min(glm::ivec3(glm::ceil(upper)), grid.size)};
    return box;
}

std::vector<std::uint32_t> screen_media(std::span<const ViewBounds> bounds) {
    constexpr glm::ivec2 tiles{SCREEN_MEDIA_X, SCREEN_MEDIA_Y};
    const std::size_t words = (bounds.size() + 31) / 32;
    std::vector<std::uint32_t> masks(words * tiles.x * tiles.y);
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        // A hair more all round: rounding never loses a pixel.
        const glm::vec2 lower = glm::clamp(bounds[i].lower, -1.0F, 2.0F) - 1e-4F;
        const glm::vec2 upper = glm::clamp(bounds[i].upper, -1.0F, 2.0F) + 1e-4F;
        const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(lower * glm::vec2(tiles))), 0);
        const glm::ivec2 end = glm::min(glm::ivec2(glm::ceil(upper * glm::vec2(tiles))), tiles);
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x)
                masks[words * static_cast<std::size_t>(y * tiles.x + x) + i / 32] |= 1U << i % 32;
    }
    return masks;
}

std::vector<std::uint32_t> live_tiles(std::span<const IndexBox> boxes, glm::ivec3 froxels) {
    const glm::ivec3 tiles = (froxels + froxel_tile - 1) / froxel_tile;
    const std::size_t words = (boxes.size() + 31) / 32;
    std::vector<std::uint32_t> masks(words * static_cast<std::size_t>(tiles.x) * tiles.y * tiles.z);
    const auto mask = [&](int x, int y, int z) {
        return masks.begin() + static_cast<std::ptrdiff_t>(words) * (x + tiles.x * (y + tiles.y * z));
    };
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const glm::ivec3 lower = boxes[i].lower / froxel_tile;
        const glm::ivec3 upper = (boxes[i].upper + froxel_tile - 1) / froxel_tile;
        for (int z = lower.z; z < upper.z; ++z)
            for (int y = lower.y; y < upper.y; ++y)
                for (int x = lower.x; x < upper.x; ++x) mask(x, y, z)[i / 32] |= 1U << (i % 32);
    }
    std::vector<std::uint32_t> live;
    for (int z = 0; z < tiles.z; ++z)
        for (int y = 0; y < tiles.y; ++y)
            for (int x = 0; x < tiles.x; ++x) {
                const auto first = mask(x, y, z), last = first + static_cast<std::ptrdiff_t>(words);
                if (std::all_of(first, last, [](std::uint32_t word) { return word == 0; })) continue;
                live.push_back(static_cast<std::uint32_t>(x | y << 10 | z << 20));
                live.insert(live.end(), first, last);
            }
    return live;
}

}  // namespace tyndall::volumetrics
