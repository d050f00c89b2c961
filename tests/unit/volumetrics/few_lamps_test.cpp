#include "light/few_lamps.h"

#include <gmock/gmock.h>

namespace tyndall::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using volumetrics::Lamp;

std::vector<std::uint32_t> chosen(const std::vector<Lamp>& lamps, float sigma_t, int most, float least) {
    std::vector<std::uint32_t> indices;
    for (const Lamp& lamp : volumetrics::choose_few_lamps(lamps, glm::vec3(0), sigma_t, most, least))
        indices.push_back(lamp.index);
    return indices;
}

const std::vector<Lamp> lamps{{.index = 3, .position = {0, 0, -10}, .intensity = 100},
                              {.index = 5, .position = {0, 0, -2}, .intensity = 50},
                              {.index = 7, .position = {0, 0, -40}, .intensity = 800},
                              {.index = 9, .position = {0, 0, -10}, .shadow = false, .intensity = 1000}};

// In clear air they send 10, 25, 20 and 100.
TEST(FewLamps, AreThoseThatSendMost) {
    EXPECT_THAT(chosen(lamps, 0, 1, 0), ElementsAre(5));
    EXPECT_THAT(chosen(lamps, 0, 2, 0), ElementsAre(5, 7));
    EXPECT_THAT(chosen(lamps, 0, 8, 0), ElementsAre(3, 5, 7));
    EXPECT_THAT(chosen(lamps, 0, 0, 0), IsEmpty());
}

TEST(FewLamps, AShareOfAllIsTheLeast) {
    EXPECT_THAT(chosen(lamps, 0, 8, 0.1F), ElementsAre(5, 7));  // of 155
    EXPECT_THAT(chosen(lamps, 0, 8, 0.15F), ElementsAre(5));
    EXPECT_THAT(chosen(lamps, 0, 8, 0.2F), IsEmpty());
}

// Its beam has edges.
TEST(FewLamps, ANarrowSpotNeedsNoShadow) {
    std::vector<Lamp> spots = lamps;
    spots[3].cos_outer = 0.6F;
    EXPECT_THAT(chosen(spots, 0, 1, 0), ElementsAre(5));
    spots[3].cos_outer = 0.9F;
    EXPECT_THAT(chosen(spots, 0, 1, 0), ElementsAre(9));
}

// The far lamp sends 20 exp(-4), the near one 25 exp(-0.2).
TEST(FewLamps, HazeHidesFarOnes) {
    EXPECT_THAT(chosen(lamps, 0.1F, 2, 0), ElementsAre(3, 5));
}

TEST(FewLamps, AShortRangeShowsInFewRays) {
    std::vector<Lamp> ranged = lamps;
    ranged[2].range = 10;  // a quarter of its distance
    EXPECT_THAT(chosen(ranged, 0, 2, 0), ElementsAre(3, 5));
}

}  // namespace
}  // namespace tyndall::test
