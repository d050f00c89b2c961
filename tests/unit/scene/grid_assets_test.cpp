#include <gtest/gtest.h>

#include <numeric>

#include "engine/scene/data_root.h"
#include "engine/scene/density_grid.h"

namespace tyndall {
namespace {

struct Measured {
    std::shared_ptr<const DensityGrid> grid;
    double mean;                  ///< of voxels above 0
    glm::dvec3 lowest, greatest;  ///< corners of the box round them, m
};

Measured measure(const std::string& file) {
    const auto grid = load_density_grid(data_root() / "assets/grids" / file, "density");
    const double sum = std::accumulate(grid->values.begin(), grid->values.end(), 0.0);
    const auto count = std::ranges::count_if(grid->values, [](float value) { return value > 0; });
    return {grid, sum / double(count), glm::dvec3(grid->index_to_grid * glm::dvec4(grid->lower, 1)),
            glm::dvec3(grid->index_to_grid * glm::dvec4(grid->upper, 1))};
}

TEST(GridAssets, TheCumulusIsACloudOnALevelBase) {
    const Measured cumulus = measure("cumulus.nvdb");
    EXPECT_LE(cumulus.grid->greatest, 1.001F);
    EXPECT_GT(cumulus.grid->greatest, 0.8F);
    EXPECT_GT(cumulus.mean, 0.2);
    EXPECT_NEAR(cumulus.lowest.y, 6, 8);
    EXPECT_GT(cumulus.greatest.y, 250);
    EXPECT_GT(cumulus.greatest.x - cumulus.lowest.x, 450);
    EXPECT_LT(std::filesystem::file_size(data_root() / "assets/grids/cumulus.nvdb"), 2'000'000U);
}

TEST(GridAssets, TheSmokeRisesFromTheOrigin) {
    const Measured smoke = measure("smoke.nvdb");
    EXPECT_LE(smoke.grid->greatest, 1.001F);
    EXPECT_GT(smoke.grid->greatest, 0.8F);
    EXPECT_NEAR(smoke.lowest.y, 0, 0.06);
    EXPECT_GT(smoke.greatest.y, 2.8);
    EXPECT_LT(smoke.lowest.x, -0.5);
    EXPECT_GT(smoke.greatest.x, 0.5);
    EXPECT_LT(std::filesystem::file_size(data_root() / "assets/grids/smoke.nvdb"), 1'000'000U);
}

}  // namespace
}  // namespace tyndall
