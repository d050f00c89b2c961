// What a player sets once: kept, read again, and refused when it is no such file.
#include "sample_game/player_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "support/command.h"

namespace tyndall::test {
namespace {

using ::testing::HasSubstr;

TEST(PlayerSettings, AreReadAsTheyWereKept) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "new/player.json";
    EXPECT_EQ(load_player_settings(path), PlayerSettings{}) << "nothing was kept yet";
    const PlayerSettings settings{.field_of_view = 75,
                                  .look_speed = 2,
                                  .invert_look = true,
                                  .full_screen = true,
                                  .quality = Quality::balanced};
    save_player_settings(path, settings);
    EXPECT_EQ(load_player_settings(path), settings);
}

TEST(PlayerSettings, OddFilesAreErrorsThatNameThem) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "player.json";
    for (const char* text :
         {"", "[1]", R"({"field_of_view": 500})", R"({"quality": "best"})", R"({"height": 2})"}) {
        write_text(path, text);
        try {
            (void)load_player_settings(path);
            ADD_FAILURE() << text;
        } catch (const Error& e) {
            EXPECT_THAT(e.what(), HasSubstr("player.json")) << text;
        }
    }
}

TEST(PlayerSettings, EveryQualityIsAPreset) {
    EXPECT_EQ(preset_of(Quality::as_started), "");
    EXPECT_EQ(preset_of(Quality::fast), "fast");
    EXPECT_EQ(preset_of(Quality::quality), "quality");
}

}  // namespace
}  // namespace tyndall::test
