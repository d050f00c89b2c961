// What the key V walks through.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_game/game.h"
#include "volumetrics/technique.h"

namespace tyndall {
namespace {

TEST(TechniqueKey, WalksThroughAllButTheReferenceAndRoundAgain) {
    std::vector<std::string> walked{"off"};
    for (std::string next = technique_after("off"); next != "off" && walked.size() < 100;
         next = technique_after(next))
        walked.push_back(next);
    std::vector<std::string> expected = volumetrics::technique_names();
    std::erase(expected, "reference");
    EXPECT_EQ(walked, expected);
    EXPECT_GE(walked.size(), 8u);
    EXPECT_EQ(technique_after("reference"), "off") << "chosen in the panel, it can be left";
}

}  // namespace
}  // namespace tyndall
