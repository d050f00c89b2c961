#include <gtest/gtest.h>

#include <numeric>

#include "engine/scene/data_root.h"
#include "engine/scene/density_grid.h"

namespace tyndall {
namespace {

/// Files from outside the project, beside its folder; absent in a fresh clone.
class GridSamples : public testing::Test {
  protected:
    std::filesystem::path data = data_root() / "../shared/data/volumes";
    void SetUp() override {
        if (!std::filesystem::exists(data / "box.vdb"))
            GTEST_SKIP() << "no test data in " << data.lexically_normal();
    }
    static double sum(const DensityGrid& grid) {
        return std::accumulate(grid.values.begin(), grid.values.end(), 0.0);
    }
};

TEST_F(GridSamples, DenseSums) {
    EXPECT_NEAR(sum(*load_density_grid(data / "wdas_cloud_sixteenth.vdb", "density")), 188'542.104, 1e-3);
    EXPECT_NEAR(sum(*load_density_grid(data / "openvdb_smoke.vdb", "density")), 171'499.696, 1e-3);
}

TEST_F(GridSamples, InactiveVoxelsAreNothingWhateverTheBackground) {
    const auto box = load_density_grid(data / "box.vdb", "density");
    EXPECT_EQ(sum(*box), 9'261);
    EXPECT_EQ(box->lower, glm::ivec3(-10));
    EXPECT_EQ(box->upper, glm::ivec3(10));
    EXPECT_EQ(box->greatest, 1);
    EXPECT_EQ(box->bricks.size(), 64U);
    EXPECT_NEAR(box->index_to_grid[0][0], 0.05, 1e-6);
}

TEST_F(GridSamples, ActiveVoxelsOfNothingDoNotCount) {
    const auto cloud = load_density_grid(data / "wdas_cloud_sixteenth.vdb", "density");
    EXPECT_EQ(cloud->lower, glm::ivec3(-64, -19, -88));
    EXPECT_EQ(cloud->upper, glm::ivec3(58, 64, 63));
    EXPECT_EQ(std::ranges::count_if(cloud->values, [](float value) { return value > 0; }), 363'037);
}

}  // namespace
}  // namespace tyndall
