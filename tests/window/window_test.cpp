// The game in a window, as a player uses it: real key and mouse events through the X server.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/files.h"
#include "engine/scene/scene.h"
#include "sample_game/ui/settings_sections.h"
#include "support/game_process.h"
#include "support/scenes.h"
#include "support/walk_files.h"
#include "volumetrics/settings.h"

namespace tyndall::test {
namespace {

glm::vec3 vector(const nlohmann::json& j) {
    return {j.at(0), j.at(1), j.at(2)};
}
glm::vec3 eye(const GameProcess::State& s) {
    return vector(s.stats.at("player").at("eye"));
}
glm::vec3 direction(const GameProcess::State& s) {
    return vector(s.stats.at("player").at("direction"));
}
std::string setting(const GameProcess::State& s, const char* key) {
    return s.stats.at("settings").at(key);
}

/// Horizontal distance to the nearest of the level's places that is not where `from` is.
float distance_to_next_place(const Scene& level, glm::vec3 from, glm::vec3 at) {
    float nearest = 1e9f, result = 0;
    for (const Camera& camera : level.cameras) {
        const glm::vec3 place(level.nodes[static_cast<std::size_t>(camera.node)].world[3]);
        const float d = glm::distance(glm::vec2(place.x, place.z), glm::vec2(from.x, from.z));
        if (camera.name == "flythrough" || d < 12 || d > nearest) continue;
        nearest = d;
        result = glm::distance(glm::vec2(place.x, place.z), glm::vec2(at.x, at.z));
    }
    return result;
}

/// By the menu.
void quit(GameProcess& game) {
    game.key("Escape");
    game.key("q");
}

double mean_difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
    return sum / static_cast<double>(a.pixels.size());
}

/// Rows of the debug UI's settings, in pixels of the window: Dear ImGui's default font and spacing.
struct Row {
    static constexpr int x = 120, first_y = 210, height = 23, popup = 24, item = 17;

    static constexpr int scale_y = 141, scale_right = 210;  // of the slider for the scale of the picture

    static std::vector<std::string> keys(const SettingsSection* section) {
        std::vector<std::string> keys;
        for (const Setting& s : volumetrics::settings_table().settings())
            if (section_of(s.key) == section) keys.push_back(s.key);
        return keys;
    }
    /// Of the section's heading, while only the technique's own section is open, as at first.
    static int heading_y(const SettingsSection* section, const std::string& technique) {
        std::size_t row = keys(nullptr).size();
        for (const SettingsSection& s : settings_sections()) {
            if (!matters(s, technique)) continue;
            if (&s == section) return first_y + static_cast<int>(row) * height;
            row += 1 + (s.own == technique ? keys(&s).size() : 0);
        }
        throw std::runtime_error("no such section for this technique");
    }
};

/// Opens the section of a technique's setting and its combo and chooses its `index`th value. The section stays
/// open, so that settings are to be chosen from the last section upwards.
void choose(GameProcess& game, const std::string& technique, const std::string& key, int index) {
    const auto click = [&](int y) {
        game.move_pointer(Row::x, y);
        game.frames(1);
        game.click();
        game.frames(2);
    };
    const SettingsSection* section = section_of(key);
    const std::vector<std::string> keys = Row::keys(section);
    const auto place = std::ranges::find(keys, key) - keys.begin();
    const int heading = Row::heading_y(section, technique),
              row = heading + Row::height * (static_cast<int>(place) + 1);
    click(heading);
    click(row);
    click(row + Row::popup + index * Row::item);
}

TEST(Window, WalkLookAndTheDebugUi) {
    if (const std::string reason = GameProcess::missing(); !reason.empty()) GTEST_SKIP() << reason;
    GameProcess game({level(),
                      "--size",
                      "448x570",
                      "--scale",
                      "0.5",
                      "--preset",
                      "balanced",
                      "--technique",
                      "off",
                      "--set",
                      "lamp_integration=center",
                      "--set",
                      "steps=2",
                      "--set",
                      "shadows=false",
                      "--set",
                      "froxels_x=32",
                      "--set",
                      "froxels_y=24",
                      "--set",
                      "froxels_z=24",
                      "--set",
                      "temporal=off",
                      "--set",
                      "noise_time=fixed"});
    game.move_pointer(380, 300);

    // On foot, in the direction the level's start looks.
    const Scene scene = load_gltf(level());
    const GameProcess::State start = game.state_when(
        [](const auto& s) { return s.stats.at("player").at("on_ground").template get<bool>(); }, "ground");
    EXPECT_FALSE(start.stats.at("player").at("flying").get<bool>());
    game.key_down("w");
    glm::vec3 last = eye(start);
    const GameProcess::State walked = game.state_when(
        [&](const auto& s) {
            const glm::vec3 step = eye(s) - last;
            EXPECT_LE(std::abs(step.y), 0.35f + std::hypot(step.x, step.z)) << "a jerk in height";
            last = eye(s);
            return glm::distance(last, eye(start)) > 3.5f;
        },
        "walk of 3.5 m");
    game.key_up("w");
    const float before = distance_to_next_place(scene, eye(start), eye(start));
    const float after = distance_to_next_place(scene, eye(start), eye(walked));
    EXPECT_LT(after, before - 2);
    const GameProcess::State stopped = game.state_when(
        [&](const auto& s) { return glm::distance(eye(s), std::exchange(last, eye(s))) < 0.01f; }, "standstill");
    EXPECT_TRUE(stopped.stats.at("player").at("on_ground").get<bool>());

    // A click takes the pointer, moving it turns the view, the menu gives it back.
    game.click();
    game.frames(1);
    game.turn_pointer(200, 0);
    const GameProcess::State turned = game.state_when(
        [&](const auto& s) { return glm::dot(direction(s), direction(stopped)) < 0.95f; }, "turn of the view");
    EXPECT_NEAR(direction(turned).y, direction(stopped).y, 0.05);
    EXPECT_LT(glm::distance(eye(turned), eye(stopped)), 0.05f);
    game.key("Escape");  // into the menu
    game.frames(1);
    game.key("Escape");  // and out of it
    game.frames(1);

    // V brings the fog back; then the debug UI takes the filter and the noise away.
    game.key("v");
    game.state_when([](const auto& s) { return setting(s, "technique") == "ray_march"; }, "technique ray_march");
    game.key("F1");
    game.frames(2);
    const GameProcess::State blurred = game.state(), same = game.state();
    ASSERT_EQ(setting(blurred, "filter"), "gaussian15");
    ASSERT_EQ(setting(blurred, "noise"), "bayer");
    EXPECT_GT(mean_difference(blurred.picture, turned.picture), 0.01) << "fog";
    const double noise = mean_difference(blurred.picture, same.picture);

    constexpr auto march = "ray_march";
    choose(game, march, "filter", 0);
    const GameProcess::State grainy = game.state();
    EXPECT_EQ(setting(grainy, "filter"), "none");
    EXPECT_GT(mean_difference(grainy.picture, blurred.picture), 2 * noise + 0.25 / 255);

    choose(game, march, "noise", 0);
    const GameProcess::State banded = game.state();
    EXPECT_EQ(setting(banded, "noise"), "none");
    EXPECT_GT(mean_difference(banded.picture, grainy.picture), 2 * noise + 0.25 / 255);

    game.key("Escape");  // the debug window
    game.frames(1);
    quit(game);
    EXPECT_EQ(game.wait_for_exit(), 0);
    EXPECT_EQ(game.stats().at("gl_messages"), 0);
}

class SmallGame : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const std::string reason = GameProcess::missing(); !reason.empty()) GTEST_SKIP() << reason;
        write_scene(folder_ / "scene.gltf",
                    {.sun = true, .media = R"([{"shape":"global","scattering":[0.01,0.01,0.01]}])"});
        game_.emplace(std::vector<std::string>{(folder_ / "scene.gltf").string(), "--size", "448x540", "--scale",
                                               "0.5", "--technique", "ray_march", "--set", "steps=2", "--set",
                                               "temporal=off"});
    }
    TemporaryFolder folder_;
    std::optional<GameProcess> game_;
};

TEST_F(SmallGame, ControlClickInASlowFrameOpensTheSlidersText) {
    game_->key("F1");
    game_->frames(2);
    const std::vector<std::string> keys = Row::keys(section_of("steps"));
    const auto place = std::ranges::find(keys, "steps") - keys.begin();
    game_->move_pointer(
        Row::x, Row::heading_y(section_of("steps"), "ray_march") + Row::height * (static_cast<int>(place) + 1));
    game_->frames(2);
    game_->stop();
    game_->key_down("ctrl");
    game_->click();
    game_->key_up("ctrl");
    game_->go_on();
    game_->frames(2);
    EXPECT_EQ(game_->state().stats.at("settings").at("steps"), 2) << "a plain click would have moved it";
    for (const char* key : {"5", "Return"}) {
        game_->key(key);
        game_->frames(1);
    }
    EXPECT_EQ(game_->state().stats.at("settings").at("steps"), 5);
}

TEST_F(SmallGame, StatisticsThatCannotBeWrittenCostNoPicture) {
    std::filesystem::remove(game_->folder() / "stats.json");
    std::filesystem::create_directory(game_->folder() / "stats.json");
    EXPECT_EQ(game_->picture().size, glm::ivec2(448, 540));
    quit(*game_);
    EXPECT_EQ(game_->wait_for_exit(), 1);
}

TEST_F(SmallGame, ThePictureFollowsTheWindowAndTheSliderOfItsScale) {
    const auto size = [](const GameProcess::State& s, const char* of) {
        return glm::ivec2(s.stats.at(of).at(0), s.stats.at(of).at(1));
    };
    GameProcess::State state = game_->state();
    EXPECT_EQ(size(state, "size"), glm::ivec2(224, 270));
    game_->resize(500, 400);
    state = game_->state_when([&](const auto& s) { return size(s, "window").x == 500; }, "resized window");
    EXPECT_EQ(size(state, "window"), glm::ivec2(500, 400));
    EXPECT_EQ(size(state, "size"), glm::ivec2(250, 200));
    EXPECT_EQ(state.picture.size, glm::ivec2(500, 400));

    game_->key("F1");
    game_->frames(2);
    game_->move_pointer(Row::scale_right, Row::scale_y);
    game_->frames(2);
    game_->click();
    state = game_->state_when([&](const auto& s) { return size(s, "size").x > 450; }, "larger scale");
    EXPECT_EQ(state.picture.size, glm::ivec2(500, 400));
    game_->key("Escape");
    game_->frames(1);
    quit(*game_);
    EXPECT_EQ(game_->wait_for_exit(), 0);
    EXPECT_EQ(game_->stats().at("gl_messages"), 0);
}

/// Presses and releases one after another, each in a frame of its own.
void keys(GameProcess& game, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        game.key(name);
        game.frames(2);
    }
}

TEST_F(SmallGame, AKeyThatIsChosenInTheMenuFlies) {
    keys(*game_, {"Escape", "Down", "Down", "Down", "Down", "Down", "Down", "space"});  // the section of the keys
    keys(*game_, {"Down", "space", "F1", "e", "Escape"});  // forward: not F1, but what was the key for using
    const std::filesystem::path kept = game_->folder() / "tyndall/player.json";
    const GameProcess::State start =
        game_->state_when([&](const auto&) { return std::filesystem::exists(kept); }, "kept settings");
    EXPECT_EQ(read_json(kept).at("key_forward"), "e");
    EXPECT_EQ(read_json(kept).at("key_use"), "w");
    game_->key_down("e");
    game_->state_when([&](const auto& s) { return glm::distance(eye(s), eye(start)) > 1; }, "flight of 1 m");
    game_->key_up("e");
    quit(*game_);
    EXPECT_EQ(game_->wait_for_exit(), 0);
}

TEST_F(SmallGame, TheMenuStopsTheGameAndKeepsWhatAPlayerSets) {
    const GameProcess::State start = game_->state();
    game_->key_down("Right");  // looks, without a mouse
    const GameProcess::State turned = game_->state_when(
        [&](const auto& s) { return glm::dot(direction(s), direction(start)) < 0.98f; }, "turn of the view");
    game_->key_up("Right");
    game_->frames(2);
    const GameProcess::State before = game_->state();

    game_->key("Escape");
    game_->frames(2);
    game_->key_down("w");
    game_->frames(4);
    EXPECT_EQ(eye(game_->state()), eye(before)) << "nobody walks behind the menu";
    game_->key_up("w");
    for (const char* key : {"Down", "space", "Right", "space"}) {  // the field of view, one step wider
        game_->key(key);
        game_->frames(2);
    }
    const std::filesystem::path kept = game_->folder() / "tyndall/player.json";
    EXPECT_FALSE(std::filesystem::exists(kept)) << "until the menu closes";
    game_->key("Escape");
    const GameProcess::State wider =
        game_->state_when([&](const auto&) { return std::filesystem::exists(kept); }, "kept settings");
    EXPECT_GT(wider.stats.at("player").at("field_of_view"), 60);
    EXPECT_NEAR(read_json(kept).at("field_of_view").get<double>(),
                wider.stats.at("player").at("field_of_view").get<double>(), 1e-3);
    quit(*game_);
    EXPECT_EQ(game_->wait_for_exit(), 0);
}

/// A small level with a walk between two lamps; a player flies there, from the camera.
class Title : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const std::string reason = GameProcess::missing(); !reason.empty()) GTEST_SKIP() << reason;
        write_scene(folder_ / "scene.gltf", {.sun = true,
                                             .lamps = {{{0, 1, 5}}, {{0, 1, -5}}},
                                             .media = R"([{"shape":"global","scattering":[0.01,0.01,0.01]}])"});
        write_text(folder_ / "scene.walk.json", walk_of_two_lamps().dump());
        game_.emplace(std::vector<std::string>{(folder_ / "scene.gltf").string(), "--begin", "title", "--size",
                                               "448x540", "--scale", "0.25", "--technique", "off"});
    }
    GameProcess::State stage(const std::string& name) {
        return game_->state_when([&](const auto& s) { return s.stats.at("stage") == name; }, name);
    }
    TemporaryFolder folder_;
    std::optional<GameProcess> game_;
};

TEST_F(Title, TheWalkIsPlayedToItsEndByKeysAlone) {
    const auto lit = [](const auto& s) { return s.stats.at("walk").at("lit").template get<int>(); };
    stage("title");
    keys(*game_, {"space"});
    stage("walk");
    keys(*game_, {"r"});
    EXPECT_TRUE(game_->state().stats.at("walk").at("lantern").get<bool>());
    for (const int lamp : {1, 2}) {
        game_->key_down("w");
        const float there = lamp == 1 ? 7.5f : -2.5f;
        game_->state_when([&](const auto& s) { return eye(s).z < there; }, "lamp");
        game_->key("e");
        game_->key_up("w");
        game_->frames(2);
        EXPECT_EQ(lit(game_->state()), lamp);
    }
    game_->state_when([](const auto& s) { return s.stats.at("walk").at("ending").template get<bool>(); }, "ending");
    stage("title");  // after the last words
    keys(*game_, {"Down", "Down"});
    game_->key("Down");
    game_->key("space");
    EXPECT_EQ(game_->wait_for_exit(), 0);
    EXPECT_EQ(game_->stats().at("gl_messages"), 0);
}

TEST_F(Title, SettingsAndExploringAndBack) {
    keys(*game_, {"Down", "Down", "Return"});  // settings
    keys(*game_, {"Down", "space", "Right", "space", "Escape"});
    const std::filesystem::path kept = game_->folder() / "tyndall/player.json";
    game_->state_when([&](const auto&) { return std::filesystem::exists(kept); }, "kept settings");
    keys(*game_, {"Down", "Return"});
    stage("explore");
    keys(*game_, {"Escape", "Down", "Down", "Down", "Down", "Down", "Down", "Down", "Down", "space"});
    stage("title");
}

}  // namespace
}  // namespace tyndall::test
