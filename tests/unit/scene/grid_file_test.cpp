#include <gmock/gmock.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <tuple>

#include "engine/core/error.h"
#include "engine/scene/density_grid.h"
#include "tests/support/grid_files.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

using Voxels = std::map<std::tuple<int, int, int>, float>;

Voxels voxels_of(const DensityGrid& grid) {
    Voxels voxels;
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
        const int n = static_cast<int>(i % DensityGrid::brick_size);
        const glm::ivec3 at = grid.bricks[i / DensityGrid::brick_size] + glm::ivec3(n % 8, n / 8 % 8, n / 64);
        if (grid.values[i] != 0) voxels[{at.x, at.y, at.z}] = grid.values[i];
    }
    return voxels;
}

/// Values that a half float holds exactly, in several leaves and on both sides of 0.
TestGrid cloud() {
    TestGrid grid;
    for (int i = 0; i < 300; ++i) {
        const glm::ivec3 at(i * 7 % 23 - 11, i * 5 % 19 - 9, i * 3 % 140 - 70);
        grid.voxels.push_back({at, 0.25F + float(i % 32) / 64});
    }
    return grid;
}
Voxels expected(const TestGrid& grid) {
    Voxels voxels;
    for (const TestGrid::Voxel& voxel : grid.voxels) voxels[{voxel.at.x, voxel.at.y, voxel.at.z}] = voxel.value;
    return voxels;
}
TestGrid one_voxel(float value, glm::ivec3 at = {1, 2, 3}) {
    TestGrid grid;
    grid.voxels = {{at, value}};
    return grid;
}

class GridFile : public SceneFolderTest {
  protected:
    std::filesystem::path vdb(const std::vector<TestGrid>& grids) const {
        write_vdb(folder / "grid.vdb", grids);
        return folder / "grid.vdb";
    }
    std::filesystem::path nanovdb(const std::vector<TestGrid>& grids) const {
        write_nanovdb(folder / "grid.nvdb", grids);
        return folder / "grid.nvdb";
    }
    static void expect_refused(const std::filesystem::path& file, const std::string& because,
                               const std::string& name = "density") {
        EXPECT_THAT([&] { (void)load_density_grid(file, name); },
                    ThrowsMessage<Error>(
                        AllOf(StartsWith(file.string() + ": "), HasSubstr(because), Not(HasSubstr("\n")))));
    }
};

TEST_F(GridFile, EveryCompressionOfVdbHoldsTheVoxels) {
    for (const auto compression : {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc}) {
        write_vdb(folder / "grid.vdb", {cloud()}, compression);
        EXPECT_EQ(voxels_of(*load_density_grid(folder / "grid.vdb", "density")), expected(cloud()));
    }
}

TEST_F(GridFile, EveryCodecOfNanoVdbHoldsTheVoxels) {
    for (const auto codec : {NanoCodec::none, NanoCodec::zip, NanoCodec::blosc})
        for (const bool whole_checksum : {false, true}) {
            write_nanovdb(folder / "grid.nvdb", {cloud()}, NanoBits::full, codec, whole_checksum);
            EXPECT_EQ(voxels_of(*load_density_grid(folder / "grid.nvdb", "density")), expected(cloud()));
        }
}

TEST_F(GridFile, HalfFloatsAreRead) {
    TestGrid half = cloud();
    half.type = TestGrid::Type::half;
    EXPECT_EQ(voxels_of(*load_density_grid(vdb({half}), "density")), expected(cloud()));
    half.voxels = {{{0, 0, 0}, 0.1F}};
    const float rounded = load_density_grid(vdb({half}), "density")->greatest;
    EXPECT_NE(rounded, 0.1F);
    EXPECT_NEAR(rounded, 0.1F, 1e-4);
}

TEST_F(GridFile, QuantisedNanoVdbIsNear) {
    const std::pair<NanoBits, double> cases[] = {{NanoBits::four, 0.76 / 30},
                                                 {NanoBits::eight, 0.76 / 510},
                                                 {NanoBits::sixteen, 1e-5},
                                                 {NanoBits::varying, 0.01}};
    for (const auto& [bits, tolerance] : cases)
        for (const auto codec : {NanoCodec::none, NanoCodec::zip, NanoCodec::blosc}) {
            write_nanovdb(folder / "grid.nvdb", {cloud()}, bits, codec);
            const Voxels found = voxels_of(*load_density_grid(folder / "grid.nvdb", "density"));
            ASSERT_EQ(found.size(), expected(cloud()).size());
            for (const auto& [at, value] : expected(cloud())) ASSERT_NEAR(found.at(at), value, tolerance + 1e-6);
        }
}

TEST_F(GridFile, TilesBecomeBricks) {
    TestGrid grid;
    grid.tiles = {
        {{-8, 0, 8}, 8, 0.5F}, {{128, 0, 0}, 128, 0.25F}, {{0, 300, 0}, 128, 0.75F, false}, {{0, 0, 5000}, 8, 0}};
    for (const auto& file : {vdb({grid}), nanovdb({grid})}) {
        const auto loaded = load_density_grid(file, "density");
        EXPECT_EQ(loaded->bricks.size(), 1U + 16U * 16U * 16U);
        EXPECT_EQ(loaded->lower, glm::ivec3(-8, 0, 0));
        EXPECT_EQ(loaded->upper, glm::ivec3(255, 127, 127));
        // Millions of voxels: each tile's are looked at in their bricks.
        for (std::size_t i = 0; i < loaded->values.size(); ++i) {
            const float expected = loaded->bricks[i / 512].x < 0 ? 0.5F : 0.25F;
            if (loaded->values[i] != expected) FAIL() << "value " << i << " is " << loaded->values[i];
        }
    }
}

TEST_F(GridFile, InactiveVoxelsAreNothing) {
    TestGrid grid = one_voxel(0.5F);
    grid.background = 1;
    grid.inactive = {{{1, 2, 4}, 0.75F}, {{100, 0, 0}, 0.75F}};
    for (const auto& file : {vdb({grid}), nanovdb({grid})}) {
        const auto loaded = load_density_grid(file, "density");
        EXPECT_EQ(voxels_of(*loaded), expected(grid));
        EXPECT_EQ(loaded->bricks.size(), 1U);
    }
}

TEST_F(GridFile, AnyAffineTransform) {
    TestGrid grid = one_voxel(1);
    grid.index_to_grid = glm::rotate(glm::translate(glm::dmat4(1), {3.0, -4.0, 5.0}), 0.7, glm::dvec3(1, 2, 3)) *
                         glm::scale(glm::dmat4(1), {0.5, -0.25, 2.0});
    grid.index_to_grid[1][0] += 0.125;
    for (const auto& file : {vdb({grid}), nanovdb({grid})}) {
        const glm::dmat4 found = load_density_grid(file, "density")->index_to_grid;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                EXPECT_NEAR(found[column][row], grid.index_to_grid[column][row], 1e-12) << column << row;
    }
}

TEST_F(GridFile, TheNamePicksTheGrid) {
    TestGrid heat = one_voxel(2);
    heat.name = "heat";
    heat.kind = TestGrid::Kind::unknown;
    for (const auto& file : {vdb({one_voxel(1), heat}), nanovdb({one_voxel(1), heat})}) {
        EXPECT_EQ(load_density_grid(file, "density")->greatest, 1);
        EXPECT_EQ(load_density_grid(file, "heat")->greatest, 2);
        expect_refused(file, "no grid \"smoke\"; there are: \"density\", \"heat\"", "smoke");
    }
}

TEST_F(GridFile, AGridMayBeEmpty) {
    TestGrid nothing = one_voxel(0);
    for (const auto& file : {vdb({nothing}), nanovdb({nothing})}) {
        const auto grid = load_density_grid(file, "density");
        EXPECT_TRUE(grid->empty());
        EXPECT_EQ(grid->greatest, 0);
        EXPECT_EQ(grid->upper, glm::ivec3(-1));
    }
}

TEST_F(GridFile, WhatIsNoDensityIsRefused) {
    const auto with = [](auto change) {
        TestGrid grid = one_voxel(1);
        change(grid);
        return grid;
    };
    const auto of_kind = [&](TestGrid::Kind kind) { return with([&](TestGrid& grid) { grid.kind = kind; }); };
    const auto of_type = [&](TestGrid::Type type) { return with([&](TestGrid& grid) { grid.type = type; }); };
    const auto flat = with([](TestGrid& grid) {
        grid.index_to_grid = glm::scale(glm::dmat4(1), glm::dvec3(1000));
        grid.index_to_grid[1] = {1000, 1e-4, 0, 0};
    });
    const auto tiny =
        with([](TestGrid& grid) { grid.index_to_grid = glm::scale(glm::dmat4(1), glm::dvec3(1e-8, 1000, 1000)); });
    const auto tile = [&](TestGrid::Tile value) { return with([&](TestGrid& grid) { grid.tiles = {value}; }); };
    const std::pair<TestGrid, std::string> cases[] = {
        {of_kind(TestGrid::Kind::level_set), "a fog volume expected"},
        {of_kind(TestGrid::Kind::staggered), "a fog volume expected"},
        {of_type(TestGrid::Type::twice), "of double"},
        {of_type(TestGrid::Type::integer), "of int32"},
        {of_type(TestGrid::Type::vector), "single-precision numbers expected"},
        {one_voxel(NAN), "a voxel is nan"},
        {one_voxel(INFINITY), "a voxel is inf"},
        {one_voxel(-0.5F), "a voxel is -0.5"},
        {one_voxel(2e6F), "a voxel is 2000000"},
        {tile({{0, 0, 0}, 8, -1}), "a voxel is -1"},
        {tile({{0, 0, 0}, 4096, 1}), "too large: more than 131072 bricks"},
        {one_voxel(1, {1 << 24, 0, 0}), "too large: a voxel at 16777216"},
        {with([](TestGrid& grid) {
             grid.voxels.push_back({{40'000, 0, 0}, 1});
         }),
         "too large: 40000 voxels long"},
        {flat, "its transform has no inverse"},
        {tiny, "its transform has voxels of 1e-08 m"},
    };
    for (const auto& [grid, because] : cases) {
        SCOPED_TRACE(because);
        expect_refused(vdb({grid}), because);
        expect_refused(nanovdb({grid}), because);
    }
    expect_refused(vdb({with([](TestGrid& grid) { grid.frustum = true; })}), "an affine transform expected");
}

TEST_F(GridFile, WhatIsNoGridFileIsRefused) {
    expect_refused(folder / "none.vdb", "No such file");
    expect_refused(folder / "none.nvdb", "No such file");
    expect_refused(folder / "none.json", "No such file");
    for (const char* name : {"text.vdb", "text.nvdb"}) expect_refused(write(name, "density\n\n"), "");
    for (const char* name : {"empty.vdb", "empty.nvdb"}) expect_refused(write(name, ""), "");
    std::filesystem::create_directories(folder / "folder.vdb");
    expect_refused(folder / "folder.vdb", "");
    expect_refused(write("cloud.abc", "x"), ".vdb, .nvdb or .json expected");
    std::filesystem::copy(vdb({cloud()}), folder / "other.nvdb");
    expect_refused(folder / "other.nvdb", "it is not a NanoVDB file");
    std::filesystem::copy(nanovdb({cloud()}), folder / "other.vdb");
    expect_refused(folder / "other.vdb", "not a VDB file");
}

}  // namespace
}  // namespace tyndall
