#include "media/grid_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "engine/core/error.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/volumetrics.h"

namespace tyndall::volumetrics {
namespace {

constexpr int side = GRID_SIDE,
              texels = side + 1;          // of a brick in the atlas: the first texels of the next ones too
constexpr int most_bricks_a_side = 1023;  // 10 bits
constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr std::uint32_t page_in_use = 1U << 30;

std::uint32_t packed(glm::ivec3 v) {
    return static_cast<std::uint32_t>(v.x | v.y << 10 | v.z << 20);
}

/// One level of detail: texel t of an axis is voxel t - 1 of the level, so that what lies a voxel before the grid
/// has a place too.
class Level {
  public:
    explicit Level(glm::ivec3 voxels) : voxels_(voxels) {}
    [[nodiscard]] glm::ivec3 voxels() const { return voxels_; }
    [[nodiscard]] glm::ivec3 size() const { return voxels_ / side + 1; }  ///< bricks
    void add(glm::ivec3 texel, float value) {
        const glm::ivec3 brick = texel >> 3;
        if (brick != last_brick_ || last_ == nullptr) {
            const auto [found, added] = index_.try_emplace(packed(brick), bricks_.size());
            if (added) bricks_.emplace_back();
            last_ = &bricks_[found->second];
            last_brick_ = brick;
        }
        (*last_)[offset(texel & 7)] += value;
    }
    [[nodiscard]] Level coarser() const {
        Level level((voxels_ + 1) / 2);
        each([&](glm::ivec3 texel, float value) { level.add(((texel - 1) >> 1) + 1, value / 8); });
        return level;
    }
    /// A brick with its apron, in parts of `greatest`; all 0: false.
    bool brick(glm::ivec3 at, float greatest, std::array<std::uint16_t, texels * texels * texels>& out) const {
        bool any = false;
        std::size_t i = 0;
        for (int z = 0; z < texels; ++z)
            for (int y = 0; y < texels; ++y)
                for (int x = 0; x < texels; ++x, ++i) {
                    const float share = value(at * side + glm::ivec3(x, y, z)) / greatest;
                    out[i] = static_cast<std::uint16_t>(std::lround(std::min(share, 1.0F) * 65535.0F));
                    any |= out[i] != 0;
                }
        return any;
    }
    /// Those that may hold something: with voxels, or next to such on their upper sides.
    [[nodiscard]] std::vector<glm::ivec3> candidates() const {
        std::vector<std::uint32_t> all;
        for (const auto& [key, index] : index_)
            for (int corner = 0; corner < 8; ++corner) {
                const glm::ivec3 at = unpacked(key) - glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
                if (glm::all(glm::greaterThanEqual(at, glm::ivec3(0)))) all.push_back(packed(at));
            }
        std::ranges::sort(all);
        all.erase(std::ranges::unique(all).begin(), all.end());
        std::vector<glm::ivec3> bricks;
        for (const std::uint32_t key : all) bricks.push_back(unpacked(key));
        return bricks;
    }

  private:
    using Brick = std::array<float, side * side * side>;
    static std::size_t offset(glm::ivec3 t) { return static_cast<std::size_t>(t.x + side * (t.y + side * t.z)); }
    static glm::ivec3 unpacked(std::uint32_t key) { return {key & 1023U, key >> 10 & 1023U, key >> 20}; }
    [[nodiscard]] float value(glm::ivec3 texel) const {
        const glm::ivec3 brick = texel >> 3;
        if (brick != read_brick_ || !read_once_) {
            const auto found = index_.find(packed(brick));
            read_ = found == index_.end() ? nullptr : &bricks_[found->second];
            read_brick_ = brick;
            read_once_ = true;
        }
        return read_ ? (*read_)[offset(texel & 7)] : 0;
    }
    void each(auto&& use) const {
        for (const auto& [key, index] : index_)
            for (int i = 0; i < side * side * side; ++i)
                if (const float value = bricks_[index][static_cast<std::size_t>(i)]; value > 0)
                    use(unpacked(key) * side + glm::ivec3(i & 7, i >> 3 & 7, i >> 6), value);
    }

    glm::ivec3 voxels_;
    std::unordered_map<std::uint32_t, std::size_t> index_;
    std::vector<Brick> bricks_;
    glm::ivec3 last_brick_{0};
    Brick* last_ = nullptr;
    mutable glm::ivec3 read_brick_{0};
    mutable const Brick* read_ = nullptr;
    mutable bool read_once_ = false;
};

Level voxels_of(const DensityGrid& grid) {
    Level level(grid.upper - grid.lower + 1);
    if (glm::any(glm::greaterThan(level.size(), glm::ivec3(most_bricks_a_side))))
        throw Error(fmt::format("volumetrics: density grid of {} x {} x {} voxels, at most {} a side expected",
                                level.voxels().x, level.voxels().y, level.voxels().z, most_bricks_a_side * side));
    for (std::size_t b = 0; b < grid.bricks.size(); ++b)
        for (int i = 0; i < DensityGrid::brick_size; ++i) {
            const float value = grid.values[b * DensityGrid::brick_size + static_cast<std::size_t>(i)];
            if (value > 0)
                level.add(grid.bricks[b] + glm::ivec3(i & 7, i >> 3 & 7, i >> 6) - grid.lower + 1, value);
        }
    return level;
}

/// Bricks one after the other, before their number tells the size of the atlas.
struct Collected {
    std::vector<std::array<std::uint16_t, texels * texels * texels>> bricks;
    std::vector<std::uint32_t> pages;  ///< of a brick its number + 1

    void add(const Level& level, float greatest) {
        const std::size_t first = pages.size();
        const glm::ivec3 size = level.size();
        const std::size_t count = std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
        require((first + count) * sizeof pages[0]);
        pages.resize(first + count);
        std::array<std::uint16_t, texels * texels * texels> brick{};
        for (const glm::ivec3 at : level.candidates()) {
            if (!level.brick(at, greatest, brick)) continue;
            bricks.push_back(brick);
            require(bricks.size() * sizeof brick);
            pages[first + static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z))] =
                static_cast<std::uint32_t>(bricks.size());
        }
    }
    static void require(std::size_t bytes) {
        if (bytes > most_bytes)
            throw Error(fmt::format("volumetrics: density grids take {} MiB, at most {} expected", bytes >> 20,
                                    most_bytes >> 20));
    }
};

void add_grid(const DensityGrid& grid, std::uint32_t* header, Collected& all) {
    if (grid.greatest <= 0) return;
    Level level = voxels_of(grid);
    for (std::uint32_t k = 0;; ++k) {
        header[1 + 2 * k] = static_cast<std::uint32_t>(all.pages.size());
        header[2 + 2 * k] = packed(level.size());
        all.add(level, grid.greatest);
        header[0] = k + 1;
        if (level.size() == glm::ivec3(1) || k + 1 == GRID_LEVELS) return;
        level = level.coarser();
    }
}

}  // namespace

GridPages grid_pages(std::span<const std::shared_ptr<const DensityGrid>> grids) {
    Collected all;
    const std::size_t headers = GRID_HEADER * grids.size();
    all.pages.resize(headers);
    std::array<std::uint32_t, GRID_HEADER> header{};
    for (std::size_t i = 0; i < grids.size(); ++i) {
        header = {};
        add_grid(*grids[i], header.data(), all);
        std::ranges::copy(header, all.pages.begin() + static_cast<std::ptrdiff_t>(GRID_HEADER * i));
    }

    GridPages result;
    const int count = std::max(static_cast<int>(all.bricks.size()), 1);
    const int across = static_cast<int>(std::ceil(std::cbrt(count)));
    result.bricks = {across, across, (count + across * across - 1) / (across * across)};
    const glm::ivec3 size = result.bricks * texels;
    result.values.resize(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
    const auto place = [&](int number) {
        return glm::ivec3(number % across, number / across % across, number / (across * across));
    };
    for (int n = 0; n < static_cast<int>(all.bricks.size()); ++n)
        for (int z = 0; z < texels; ++z)
            for (int y = 0; y < texels; ++y) {
                const glm::ivec3 at = place(n) * texels + glm::ivec3(0, y, z);
                const auto row = all.bricks[std::size_t(n)].begin() + texels * (y + texels * z);
                std::copy(row, row + texels,
                          result.values.begin() + (std::ptrdiff_t(at.z) * size.y + at.y) * size.x + at.x);
            }
    for (std::size_t i = headers; i < all.pages.size(); ++i)
        if (all.pages[i] != 0) all.pages[i] = page_in_use | packed(place(static_cast<int>(all.pages[i]) - 1));
    result.pages = std::move(all.pages);
    return result;
}

void GridAtlas::prepare(const Grids& grids) {
    if (grids == grids_) return;
    release();
    if (grids.empty()) return;
    GridPages pages = grid_pages(grids);
    constexpr int row = 1 << GRID_ROW_BITS;
    const int rows = static_cast<int>((pages.pages.size() + row - 1) / row);
    pages.pages.resize(std::size_t(rows) * row);
    pages_ = gl::Texture({.format = GL_R32UI, .size = {row, rows, 1}}, "volumetrics pages of density grids");
    pages_.upload(0, GL_RED_INTEGER, GL_UNSIGNED_INT, pages.pages.data());
    bricks_ = gl::Texture({.kind = gl::TextureKind::d3, .format = GL_R16, .size = pages.bricks * texels},
                          "volumetrics bricks of density grids");
    bricks_.upload(0, GL_RED, GL_UNSIGNED_SHORT, pages.values.data());
    glTextureParameteri(bricks_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(pages_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    grids_ = grids;
}

void GridAtlas::bind() const {
    if (!bricks_) return;
    glBindTextureUnit(UNIT_GRID_PAGES, pages_.id());
    glBindTextureUnit(UNIT_GRID_BRICKS, bricks_.id());
    for (const GLuint unit : {UNIT_GRID_PAGES, UNIT_GRID_BRICKS}) glBindSampler(unit, 0);
}

std::size_t GridAtlas::bytes() const {
    std::size_t bytes = 0;
    for (const gl::Texture* texture : {&pages_, &bricks_})
        if (*texture) bytes += gl::byte_size(texture->desc());
    return bytes;
}

}  // namespace tyndall::volumetrics
