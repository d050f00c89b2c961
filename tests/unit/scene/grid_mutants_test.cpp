// Damaged grid files: whatever is in them, the answer is a valid grid or an error of one line, in bounded time and
// memory. Many more than the suite's few:
//     TYNDALL_GRID_MUTANTS=500 build/release/tests/unit_tests --gtest_filter='GridMutants*'
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <tuple>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/scene/density_grid.h"
#include "tests/support/grid_files.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

int wanted_mutants() {
    const char* count = std::getenv("TYNDALL_GRID_MUTANTS");
    return count != nullptr ? std::atoi(count) : 15;
}

std::string mutant(const std::string& file, std::mt19937& random) {
    const auto below = [&](std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
    };
    std::string bytes = file;
    switch (below(5)) {
        case 0:
            bytes.resize(below(bytes.size()));
            break;
        case 1: {  // a number of 8 bytes
            const std::uint64_t odd[] = {0, 1, ~std::uint64_t{0}, std::uint64_t{1} << 31U, std::uint64_t{1} << 40U};
            if (bytes.size() > 8)
                bytes.replace(below(bytes.size() - 8), 8, reinterpret_cast<const char*>(&odd[below(5)]), 8);
            break;
        }
        case 2:  // heads and trees lie in front
            bytes[below(std::min<std::size_t>(bytes.size(), 2048))] ^= static_cast<char>(1U << below(8));
            break;
        default:
            for (std::size_t flips = 1 + below(4); flips > 0; --flips)
                bytes[below(bytes.size())] ^= static_cast<char>(1 + below(255));
    }
    return bytes;
}

void expect_valid(const DensityGrid& grid) {
    ASSERT_EQ(grid.values.size(), grid.bricks.size() * DensityGrid::brick_size);
    std::set<std::tuple<int, int, int>> places;
    for (const glm::ivec3& brick : grid.bricks) {
        for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(brick[axis] % DensityGrid::side, 0);
        ASSERT_TRUE(places.insert({brick.x, brick.y, brick.z}).second);
    }
    float greatest = 0;
    for (const float value : grid.values) {
        ASSERT_TRUE(value >= 0 && value <= 1e6F) << value;
        greatest = std::max(greatest, value);
    }
    ASSERT_EQ(grid.greatest, greatest);
    ASSERT_TRUE(std::isfinite(glm::determinant(glm::inverse(grid.index_to_grid))));
    if (grid.empty()) return;
    for (int axis = 0; axis < 3; ++axis) ASSERT_LT(grid.upper[axis] - grid.lower[axis], 1 << 15);
}

class GridMutants : public SceneFolderTest {
  protected:
    struct Outcome {
        int whole = 0, refused = 0;
        double slowest = 0;  ///< s
    };

    static TestGrid small_cloud() {
        TestGrid grid;
        grid.background = 0.125F;
        grid.tiles = {{{16, 0, 0}, 8, 0.5F}, {{128, 0, 0}, 128, 0.25F, false}};
        grid.index_to_grid[3] = {1, 2, 3, 1};
        for (int i = 0; i < 500; ++i)
            grid.voxels.push_back({{i * 7 % 23 - 11, i * 5 % 19 - 9, i * 3 % 40 - 20}, 0.1F + float(i % 32) / 64});
        return grid;
    }

    /// Loads `header` after each change of `changed`, which may be the same file.
    void damage(const std::filesystem::path& changed, const std::filesystem::path& header, std::uint32_t seed,
                Outcome& outcome) const {
        const std::string whole = read_text(changed);
        std::mt19937 random(seed);
        for (int i = 0; i < per_file; ++i) {
            SCOPED_TRACE(fmt::format("mutant {} of {}", i, changed.string()));
            write_text(changed, mutant(whole, random));
            const auto began = std::chrono::steady_clock::now();
            try {
                expect_valid(*load_density_grid(header, "density"));
                ++outcome.whole;
            } catch (const Error& e) {
                const std::string message = e.what();
                EXPECT_TRUE(message.starts_with(header.string())) << message;
                EXPECT_EQ(message.find('\n'), std::string::npos) << message;
                EXPECT_LT(message.size(), 600U) << message;
                ++outcome.refused;
                if (wanted_mutants() > 100) std::printf("%s\n", message.c_str());
            }
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
            EXPECT_LT(took.count(), 11);
            outcome.slowest = std::max(outcome.slowest, took.count());
        }
        write_text(changed, whole);
    }

    static void report(const char* format, const Outcome& outcome) {
        rusage children{};
        getrusage(RUSAGE_CHILDREN, &children);
        const double mebibytes = double(children.ru_maxrss) / 1024;
        std::printf(
            "%s: %d mutants refused, %d read as grids; the slowest took %.2f s; children held %.0f MiB at most\n",
            format, outcome.refused, outcome.whole, outcome.slowest, mebibytes);
        EXPECT_GT(outcome.refused, 0);
#if !defined(TYNDALL_SANITIZED)
        EXPECT_LT(mebibytes, 1024);
#endif
    }

    int per_file = 1;
};

TEST_F(GridMutants, Vdb) {
    Outcome outcome;
    const VdbCompression compressions[] = {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc};
    per_file = (wanted_mutants() + 2) / 3;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const auto file = folder / "grid.vdb";
        write_vdb(file, {small_cloud()}, compressions[i]);
        damage(file, file, 1 + i, outcome);
    }
    report("vdb", outcome);
}

TEST_F(GridMutants, NanoVdb) {
    Outcome outcome;
    const std::tuple<NanoBits, NanoCodec, bool> kinds[] = {{NanoBits::full, NanoCodec::none, false},
                                                           {NanoBits::full, NanoCodec::none, true},
                                                           {NanoBits::varying, NanoCodec::none, false},
                                                           {NanoBits::eight, NanoCodec::zip, false},
                                                           {NanoBits::four, NanoCodec::blosc, true}};
    per_file = (wanted_mutants() + 4) / 5;
    std::uint32_t seed = 11;
    for (const auto& [bits, codec, whole_checksum] : kinds) {
        const auto file = folder / "grid.nvdb";
        write_nanovdb(file, {small_cloud()}, bits, codec, whole_checksum);
        damage(file, file, seed++, outcome);
    }
    report("nvdb", outcome);
}

TEST_F(GridMutants, VolumeTexture) {
    Outcome outcome;
    per_file = (wanted_mutants() + 3) / 4;
    Image strip({5, 4 * 3}, 1);
    for (std::size_t i = 0; i < strip.pixels.size(); ++i) strip.pixels[i] = float(i) / 64;
    std::uint32_t seed = 21;
    for (const char* image : {"x.png", "x.exr"}) {
        write_image(folder / image, strip);
        const nlohmann::json header{{"image", image}, {"size", {5, 4, 3}}, {"voxel_size", 0.5}};
        write_text(folder / "grid.json", header.dump());
        damage(folder / image, folder / "grid.json", seed++, outcome);
    }
    const nlohmann::json header{
        {"image", "x.raw"}, {"size", {5, 4, 3}}, {"type", "f32"}, {"voxel_size", 0.5}, {"origin", {1, 2, 3}}};
    write_text(folder / "x.raw", std::string(reinterpret_cast<const char*>(strip.pixels.data()), 4 * 60));
    write_text(folder / "grid.json", header.dump());
    damage(folder / "x.raw", folder / "grid.json", seed++, outcome);
    damage(folder / "grid.json", folder / "grid.json", seed++, outcome);
    report("volume texture", outcome);
}

}  // namespace
}  // namespace tyndall
