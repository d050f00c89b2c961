#include <gmock/gmock.h>

#include <sstream>

#include "support/command.h"

namespace tyndall::test {
namespace {

TEST(Inspect, OurOwnScenesLookLikeNoMistake) {
    std::istringstream scenes(run_tyndall({"list", "scenes"}).out);
    int seen = 0;
    for (std::string scene; std::getline(scenes, scene); ++seen) {
        const CommandResult result = run_tyndall({"inspect", scene});
        EXPECT_EQ(result.exit_code, 0) << scene;
        EXPECT_THAT(result.out, testing::EndsWith("left out: none\nwarnings: none\n")) << scene;
        EXPECT_EQ(result.err, "") << scene;
    }
    EXPECT_GT(seen, 20);
}

}  // namespace
}  // namespace tyndall::test
