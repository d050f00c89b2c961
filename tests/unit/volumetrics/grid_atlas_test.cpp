// What the GPU is given of density grids, read back by its own rules: see
// modules/volumetrics/src/media/grid_atlas.h and shaders/volumetrics/media/grid.glsl.
#include "media/grid_atlas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/scene/data_root.h"
#include "engine/scene/density_grid.h"
#include "shaders/shared/volumetrics.h"
#include "tests/support/voxels.h"

namespace tyndall::volumetrics {
namespace {

using test::Voxels;

std::shared_ptr<const DensityGrid> module_grid(const std::shared_ptr<const tyndall::DensityGrid>& grid) {
    return density_grid(grid->bricks, grid->values, grid);
}

/// A level of one grid.
class LevelReader {
  public:
    LevelReader(const GridPages& pages, std::size_t grid, std::uint32_t level) : pages_(pages) {
        const std::uint32_t* header = pages.pages.data() + GRID_HEADER * grid;
        first_ = header[1 + 2 * level];
        const std::uint32_t size = header[2 + 2 * level];
        size_ = {size & 1023U, size >> 10 & 1023U, size >> 20};
    }
    [[nodiscard]] glm::ivec3 size() const { return size_; }
    [[nodiscard]] bool present(glm::ivec3 brick) const { return page(brick) != 0; }
    /// Of a brick's texel, 0 to 8 on each axis, the last ones those of the next bricks.
    [[nodiscard]] double texel(glm::ivec3 brick, glm::ivec3 in) const {
        const std::uint32_t word = page(brick);
        if (word == 0) return 0;
        const glm::ivec3 at = 9 * glm::ivec3(word & 1023U, word >> 10 & 1023U, word >> 20 & 1023U) + in;
        const glm::ivec3 whole = 9 * pages_.bricks;
        return pages_.values[static_cast<std::size_t>(at.x + whole.x * (at.y + whole.y * at.z))] / 65535.0;
    }
    /// Every texel once.
    [[nodiscard]] double sum() const {
        double sum = 0;
        each_brick([&](glm::ivec3 brick) {
            for (int i = 0; i < 512; ++i) sum += texel(brick, {i & 7, i >> 3 & 7, i >> 6});
        });
        return sum;
    }
    void each_brick(auto&& use) const {
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x) use(glm::ivec3(x, y, z));
    }

  private:
    [[nodiscard]] std::uint32_t page(glm::ivec3 b) const {
        return pages_.pages[first_ + static_cast<std::uint32_t>(b.x + size_.x * (b.y + size_.y * b.z))];
    }
    const GridPages& pages_;
    std::uint32_t first_ = 0;
    glm::ivec3 size_{0};
};

std::uint32_t levels(const GridPages& pages, std::size_t grid) {
    return pages.pages[GRID_HEADER * grid];
}

Voxels lumps() {
    Voxels voxels;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int lump = 0; lump < 12; ++lump) {
        const glm::ivec3 at(glm::vec3(unit(random), unit(random), unit(random)) * 60.0F - 30.0F);
        for (int i = 0; i < 80; ++i)
            voxels.set(at + glm::ivec3(glm::vec3(unit(random), unit(random), unit(random)) * 6.0F),
                       3 * unit(random));
    }
    return voxels;
}

TEST(GridAtlas, EveryVoxelIsInItsPlaceAndRepeatedBesideIt) {
    const Voxels voxels = lumps();
    const auto grid = module_grid(voxels.grid());
    const std::vector grids{module_grid(Voxels{{{{5, 5, 5}, 1.0F}}}.grid()), grid};
    const GridPages pages = grid_pages(grids);
    const LevelReader level(pages, 1, 0);
    level.each_brick([&](glm::ivec3 brick) {
        for (int i = 0; i < 729; ++i) {
            const glm::ivec3 in(i % 9, i / 9 % 9, i / 81);
            const glm::ivec3 voxel = grid->lower + brick * 8 + in - 1;
            EXPECT_NEAR(level.texel(brick, in) * double(grid->greatest), voxels.get(voxel.x, voxel.y, voxel.z),
                        double(grid->greatest) / 131'070 * 1.02);
        }
    });
}

TEST(GridAtlas, LevelsHoldTheSameMassDownToOneBrick) {
    const auto grid = module_grid(lumps().grid());
    const GridPages pages = grid_pages(std::vector{grid});
    ASSERT_GE(levels(pages, 0), 3U);
    for (std::uint32_t k = 0; k < levels(pages, 0); ++k) {
        const LevelReader level(pages, 0, k);
        EXPECT_NEAR(level.sum() * std::exp2(3.0 * k) * double(grid->greatest) / grid->sum, 1, 2e-3)
            << "level " << k;
    }
    EXPECT_EQ(LevelReader(pages, 0, levels(pages, 0) - 1).size(), glm::ivec3(1));
}

TEST(GridAtlas, EmptyBricksHaveNoPage) {
    Voxels two;
    two.set({0, 0, 0}, 1);
    two.set({100, 0, 0}, 1);
    const GridPages pages = grid_pages(std::vector{module_grid(two.grid())});
    const LevelReader level(pages, 0, 0);
    int present = 0;
    level.each_brick([&](glm::ivec3 brick) { present += level.present(brick) ? 1 : 0; });
    EXPECT_LE(present, 3);  // a voxel at a brick's border is in the one before it too
    EXPECT_GE(level.size().x, 13);
}

TEST(GridAtlas, DenseSumsOfFilesComeBack) {
    const std::filesystem::path data = data_root() / "../shared/data/volumes";
    if (!std::filesystem::exists(data / "box.vdb")) GTEST_SKIP() << "no test data in " << data.lexically_normal();
    for (const auto& [file, sum] : {std::pair{"wdas_cloud_sixteenth.vdb", 188'542.104},
                                    std::pair{"openvdb_smoke.vdb", 171'499.696}, std::pair{"box.vdb", 9'261.0}}) {
        const auto grid = module_grid(load_density_grid(data / file, "density"));
        const GridPages pages = grid_pages(std::vector{grid});
        EXPECT_NEAR(LevelReader(pages, 0, 0).sum() * double(grid->greatest) / sum, 1, 1e-4) << file;
    }
}

TEST(GridAtlas, WhatDoesNotFitIsSaid) {
    Voxels far_apart;
    far_apart.set({0, 0, 0}, 1);
    far_apart.set({9000, 0, 0}, 1);
    EXPECT_THROW((void)grid_pages(std::vector{module_grid(far_apart.grid())}), std::exception);
    Voxels too_many_pages;
    too_many_pages.set({0, 0, 0}, 1);
    too_many_pages.set({8000, 8000, 8000}, 1);
    EXPECT_THROW((void)grid_pages(std::vector{module_grid(too_many_pages.grid())}), std::exception);
}

}  // namespace
}  // namespace tyndall::volumetrics
