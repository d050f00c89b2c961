// The walk without scene and screen: any order, nothing lost, an end; and files that are no walk.
#include "sample_game/walk/walk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "support/walk_files.h"

namespace tyndall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double dt = 0.1;

class TwoLamps : public ::testing::Test {
  protected:
    /// For so many seconds at a place.
    void stay(glm::vec3 eye, double seconds) {
        for (double t = 0; t < seconds; t += dt) walk_.update({.eye = eye}, dt);
    }
    void lantern() { walk_.update({.eye = nowhere, .lantern = true}, dt); }
    void use(glm::vec3 eye) { walk_.update({.eye = eye, .use = true}, dt); }

    const WalkScript script_ = parse_walk(walk_of_two_lamps(), "walk");
    const glm::vec3 first_ = script_.places[0].at, second_ = script_.places[1].at, nowhere{500, 0, 0};
    Walk walk_{script_};
};

TEST_F(TwoLamps, BeginsInTheDarkWithWordsAndWhatToDo) {
    stay(nowhere, 1);
    EXPECT_EQ(walk_.words(), script_.beginning[0]);
    EXPECT_EQ(walk_.lit(), 0u);
    EXPECT_EQ(walk_.evening(), 0);
    EXPECT_FALSE(walk_.lantern());
    stay(nowhere, 60);
    EXPECT_THAT(walk_.prompt(), HasSubstr("{lantern}"));
    lantern();
    stay(nowhere, 1);
    EXPECT_THAT(walk_.prompt(), HasSubstr(script_.places[0].hint));
}

TEST_F(TwoLamps, EveryOrderEnds) {
    for (const bool backwards : {false, true}) {
        walk_ = Walk(script_);
        lantern();
        use(backwards ? second_ : first_);
        EXPECT_EQ(walk_.burning(backwards ? 1 : 0), 0);
        EXPECT_EQ(walk_.words(), script_.places[backwards ? 1 : 0].words);
        stay(nowhere, 100);
        EXPECT_NEAR(walk_.evening(), 0.5, 1e-6);
        EXPECT_FALSE(walk_.ending());
        EXPECT_THAT(walk_.prompt() + script_.places[backwards ? 0 : 1].hint,
                    HasSubstr(script_.places[backwards ? 0 : 1].hint));
        use(backwards ? first_ : second_);
        EXPECT_EQ(walk_.lit(), 2u);
        stay(nowhere, 12);
        EXPECT_TRUE(walk_.ending());
        EXPECT_EQ(walk_.evening(), 1);
        EXPECT_EQ(walk_.words(), script_.end_words[0]);
        EXPECT_FALSE(walk_.over());
        stay(nowhere, 60);
        EXPECT_TRUE(walk_.over());
    }
}

TEST_F(TwoLamps, AKeyEndsTheLastPicture) {
    lantern();
    use(first_);
    use(second_);
    stay(nowhere, 12);
    ASSERT_TRUE(walk_.ending());
    stay(nowhere, 3);
    use(nowhere);
    EXPECT_TRUE(walk_.over());
}

TEST_F(TwoLamps, UsingAgainAndElsewhereChangesNothing) {
    use(first_);
    EXPECT_EQ(walk_.lit(), 0u) << "the lantern is out";
    EXPECT_THAT(walk_.prompt(), HasSubstr("{lantern}"));
    lantern();
    use(nowhere);
    EXPECT_EQ(walk_.lit(), 0u);
    use(first_);
    stay(first_, 5);
    use(first_);
    EXPECT_GT(walk_.burning(0), 4.9) << "it burns since it was lit";
    lantern();
    EXPECT_FALSE(walk_.lantern());
    EXPECT_EQ(walk_.lit(), 1u) << "lamps burn without the lantern";
}

TEST_F(TwoLamps, WhoFallsOutOfTheLevelGoesOn) {
    lantern();
    use(first_);
    stay({0, -1e6f, 0}, 100);
    EXPECT_EQ(walk_.lit(), 1u);
    EXPECT_TRUE(walk_.is_lost());
    use(second_);
    EXPECT_EQ(walk_.lit(), 2u);
}

TEST_F(TwoLamps, WhoIsLostIsToldTheWayNowAndThen) {
    lantern();
    use(first_);
    stay(nowhere, script_.hint_after - 1);
    EXPECT_THAT(walk_.prompt(), IsEmpty());
    bool told = false, silent = false;
    stay(nowhere, 2);
    for (int i = 0; i < 60; ++i) {
        (walk_.prompt().empty() ? silent : told) = true;
        stay(nowhere, 1);
    }
    EXPECT_TRUE(told && silent);
}

TEST_F(TwoLamps, StandsStillWithTime) {
    lantern();
    use(first_);
    for (int i = 0; i < 1000; ++i) walk_.update({.eye = nowhere}, 0);
    EXPECT_EQ(walk_.burning(0), 0);
}

TEST(Walk, DirectionsAreThoseOfThePlayer) {
    const glm::vec3 north(0, 0, -1), east(1, 0, 0);
    EXPECT_EQ(direction_words(north, {0, 5, -10}), "ahead");
    EXPECT_EQ(direction_words(north, {10, 0, -1}), "to the right");
    EXPECT_EQ(direction_words(north, {-10, 0, 0}), "to the left");
    EXPECT_EQ(direction_words(north, {1, 0, 10}), "behind you");
    EXPECT_EQ(direction_words(east, {0, 0, 10}), "to the right");
}

TEST(WalkScript, BadFilesSayWhatIsWrongInALine) {
    const auto refusal = [](const char* pointer, const nlohmann::json& value) -> std::string {
        nlohmann::json json = walk_of_two_lamps();
        json[nlohmann::json::json_pointer(pointer)] = value;
        try {
            (void)parse_walk(json, "a.walk.json");
        } catch (const Error& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
            EXPECT_THAT(e.what(), HasSubstr("a.walk.json"));
            return e.what();
        }
        ADD_FAILURE() << pointer << " = " << value;
        return {};
    };
    EXPECT_THAT(refusal("", nlohmann::json::array()), HasSubstr("an object"));
    EXPECT_THAT(refusal("/places", nlohmann::json::array()), HasSubstr("places"));
    EXPECT_THAT(refusal("/places/1/reach", -1), HasSubstr("places[1].reach"));
    EXPECT_THAT(refusal("/places/0/at", {1, 2}), HasSubstr("3 numbers"));
    EXPECT_THAT(refusal("/places/0/lamps/from/0", 1e6), HasSubstr("lamps"));
    EXPECT_THAT(refusal("/places/0/colour", 1), HasSubstr("colour"));
    EXPECT_THAT(refusal("/places/0/fog", {{{"medium", -1}, {"before", 1}}}), HasSubstr("fog[0].medium"));
    EXPECT_THAT(refusal("/beginning", nlohmann::json::array()), HasSubstr("beginning"));
    EXPECT_THAT(refusal("/beginning/0", 3), HasSubstr("beginning[0]"));
    EXPECT_THAT(refusal("/hint_after", 0), HasSubstr("hint_after"));
    EXPECT_THAT(refusal("/end/look", walk_of_two_lamps()["end"]["eye"]), HasSubstr("end"));
    EXPECT_THAT(refusal("/night/sun", 2), HasSubstr("night.sun"));
    EXPECT_THAT(refusal("/lantern/candela", "bright"), HasSubstr("lantern.candela"));
    nlohmann::json json = walk_of_two_lamps();
    json.erase("night");
    EXPECT_THROW((void)parse_walk(json, "a"), Error);
}

}  // namespace
}  // namespace tyndall::test
