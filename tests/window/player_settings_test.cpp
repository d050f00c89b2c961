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
                                  .quality = Quality::balanced,
                                  .keys = {.forward = Key::z, .use = Key::page_up}};
    save_player_settings(path, settings);
    EXPECT_EQ(load_player_settings(path), settings);
}

TEST(PlayerSettings, OddFilesAreErrorsThatNameThem) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "player.json";
    for (const char* text : {"", "[1]", R"({"field_of_view": 500})", R"({"quality": "best"})", R"({"height": 2})",
                             R"({"key_jump": "e"})", R"({"key_jump": "f1"})", R"({"key_use": "ß"})"}) {
        write_text(path, text);
        try {
            (void)load_player_settings(path);
            ADD_FAILURE() << text;
        } catch (const Error& e) {
            EXPECT_THAT(e.what(), HasSubstr("player.json")) << text;
        }
    }
}

const Setting& key_row(const std::string& key) {
    for (const Setting& row : key_bindings_table().settings())
        if (row.key == key) return row;
    throw Error("no row " + key);
}

TEST(KeyBindings, AKeyThatIsTakenIsSwapped) {
    KeyBindings keys;
    EXPECT_EQ(problem_of(keys), "");
    EXPECT_EQ(rebind(keys, key_row("key_use"), Key::w), "");
    EXPECT_EQ(keys, (KeyBindings{.forward = Key::e, .use = Key::w}));
    EXPECT_EQ(rebind(keys, key_row("key_use"), Key::w), "") << "its own key again";
    EXPECT_EQ(rebind(keys, key_row("key_jump"), Key::page_up), "");
    EXPECT_EQ(keys, (KeyBindings{.forward = Key::e, .jump = Key::page_up, .use = Key::w}));
    EXPECT_EQ(problem_of(keys), "");
}

TEST(KeyBindings, KeysOfTheGamesOwnAreRefused) {
    for (const Key key : {Key::escape, Key::f1, Key::num_7, Key::left, Key::g}) {
        KeyBindings keys;
        EXPECT_THAT(rebind(keys, key_row("key_left"), key), HasSubstr(key_label(key)));
        EXPECT_EQ(keys, KeyBindings{});
    }
}

TEST(KeyBindings, ProblemsNameBothRows) {
    EXPECT_EQ(problem_of({.jump = Key::q, .lantern = Key::q}), "key_jump and key_lantern are both Q");
    EXPECT_THAT(problem_of({.use = Key::h}), HasSubstr("key_use"));
}

TEST(KeyBindings, WordsNameThem) {
    EXPECT_EQ(with_keys("{lantern}, {use} and {other}", {.use = Key::page_down}, false),
              "R, Page down and {other}");
    EXPECT_EQ(with_keys("{lantern} {use}", {}, true), "B X");
}

TEST(PlayerSettings, EveryQualityIsAPreset) {
    EXPECT_EQ(preset_of(Quality::as_started), "");
    EXPECT_EQ(preset_of(Quality::fast), "fast");
    EXPECT_EQ(preset_of(Quality::quality), "quality");
}

}  // namespace
}  // namespace tyndall::test
