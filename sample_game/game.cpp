#include "sample_game/game.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/core/image.h"
#include "engine/core/image_encode.h"
#include "engine/core/log.h"
#include "engine/core/output_files.h"
#include "engine/platform/frame_clock.h"
#include "sample_game/frame_budget.h"
#include "sample_game/level_logic.h"
#include "sample_game/play_choice.h"
#include "sample_game/player.h"
#include "sample_game/screen.h"
#include "sample_game/stats_json.h"
#include "sample_game/ui/debug_ui.h"
#include "volumetrics/technique.h"

namespace tyndall {
namespace {

constexpr float game_znear = 0.08f;
constexpr float least_kept_scale = 0.25f;  // below it the level is not to be recognised
constexpr double message_seconds = 2.5, help_seconds = 15;
constexpr const char* help =
    "click: look around   WASD: walk   shift: run   space: jump   F: fly   1-7: places\n"
    "T: time of day   G: fog   V: technique   F1: settings   F2: picture   H: hide this\n"
    "Esc: pause, player's settings, quit";

constexpr float sway = glm::radians(7.0f);  // of a view that nobody walks in
constexpr double sway_period = 70;          // s

const std::array<std::string, 7> places{"LocalPM", "Close", "LocalLights", "Sun", "Depth", "Balance", "Glass"};

/// Real seconds since the last call, for what people read; 0 at first, for the first frame builds shaders.
class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const auto last = std::exchange(last_, now);
        return last ? std::chrono::duration<double>(now - *last).count() : 0;
    }

  private:
    std::optional<std::chrono::steady_clock::time_point> last_;
};

/// The first of tyndall-001.png, tyndall-002.png … that is not there yet.
std::string unused_screenshot_name() {
    for (int i = 1;; ++i)
        if (std::string name = fmt::format("tyndall-{:03}.png", i); !std::filesystem::exists(name)) return name;
}

/// Slowly turning to and fro.
View swaying_view(const WalkScript::View& view, double time, float fov, float aspect) {
    const float angle = sway * static_cast<float>(std::sin(time * glm::two_pi<double>() / sway_period));
    const glm::vec3 way = glm::angleAxis(angle, glm::vec3(0, 1, 0)) * (view.look - view.eye);
    return look_at(view.eye, view.eye + way, fov, game_znear, aspect);
}

class Game {
  public:
    Game(Session& session, const GameOptions& options)
        : session_(session),
          options_(options),
          player_(session.scene),
          logic_(session.scene),
          ui_(*session.shaders),
          screen_(*session.shaders),
          scale_(options.scale) {
        session.timer->set_mode(session.timer_mode());
        session.options.progressive = true;
        if (options.frame_budget > 0 && options.fixed_step == 0)
            budget_.emplace(options.frame_budget, std::min(least_kept_scale, scale_), 1.0f);
        session.context->set_full_screen(settings_.full_screen);
        ui_.has_title = options.walk.has_value();
        enter(options.begin);
    }

    void frame(double dt) {
        GlContext& context = *session_.context;
        const Input& input = context.input();
        context.poll();
        context.input().keys_pressed |= std::exchange(early_keys_, {});
        const glm::ivec2 window = glm::max(context.framebuffer_size(), glm::ivec2(1));
        session_.size = scaled_size(window, scale_);
        keys(input);
        pointer(input);
        if (ui_.paused) dt = 0;
        player_.look_speed = settings_.look_speed;
        player_.invert_look = settings_.invert_look;
        player_.keys = settings_.keys;
        time_ += dt;
        session_.shaders->reload_changed();
        animate(session_.scene, time_);
        move(ui_.paused || ui_.wants_keyboard() ? Input{} : input, dt);
        session_.draw(view(static_cast<float>(window.x) / static_cast<float>(window.y)), time_);
        screen_.show(*session_.renderer, window);
        if (screenshot_requested_) screenshot();

        const double seconds = stopwatch_.lap();
        message_seconds_left_ -= seconds;
        frame_ms_ = frame_ms_ == 0 ? seconds * 1e3 : frame_ms_ + (seconds * 1e3 - frame_ms_) * 0.1;
        DebugUi::Hud hud{where(), frame_ms_, message_seconds_left_ > 0 ? message_ : std::string{},
                         stage_ != Stage::explore, walk_banner()};
        if (budget_ && seconds > 0) scale_ = budget_->next(scale_, seconds * 1e3);
        const float scale = scale_;
        const PlayerSettings before = settings_;
        const DebugUi::Requests requests =
            ui_.frame(session_, logic_, hud, screen_, scale_, seconds, !captured_, settings_);
        if (settings_ != before) player_changed(before);
        menu(requests.menu);
        if (scale_ != scale) budget_.reset();  // set by hand
        screenshot_requested_ = requests.screenshot;
        context.present(screen_.framebuffer(), screen_.size());
    }

    void keep_settings() {
        if (settings_ == kept_) return;
        try {
            save_player_settings(options_.player_path, settings_);
            kept_ = settings_;
        } catch (const Error& e) {
            say(std::string("not kept: ") + e.what());
        }
    }
    [[nodiscard]] const Screen& screen() const { return screen_; }

    [[nodiscard]] std::string stats() const {
        const glm::vec3 eye = player_.eye(), direction = player_.direction();
        nlohmann::json stats = stats_json(session_);
        stats["player"] = {{"eye", {eye.x, eye.y, eye.z}},
                           {"direction", {direction.x, direction.y, direction.z}},
                           {"field_of_view", settings_.field_of_view},
                           {"flying", player_.flying()},
                           {"on_ground", player_.on_ground()}};
        stats["stage"] = stage_ == Stage::title ? "title" : stage_ == Stage::walk ? "walk" : "explore";
        if (walk_)
            stats["walk"] = {{"lit", walk_->lit()}, {"lantern", walk_->lantern()}, {"ending", walk_->ending()}};
        stats["window"] = {screen_.size().x, screen_.size().y};
        stats["gl_messages"] = debug_messages().count;
        return stats.dump(2) + "\n";
    }

  private:
    /// From its beginning, in the light that the level was made with.
    void enter(Stage stage) {
        stage_ = stage;
        ui_.title.reset();
        if (stage == Stage::title) ui_.title = options_.walk->script().title_words;
        ui_.visible = ui_.paused = false;
        ui_.hud_visible = ui_.has_level = stage == Stage::explore;
        ui_.places.clear();
        for (const std::string& place : places)
            if (stage == Stage::explore && session_.scene.find_camera(place) != nullptr)
                ui_.places.push_back(place);
        walk_.reset();
        logic_.set_day_time(session_.scene, 0);
        logic_.set_fog(session_.scene, 0);
        if (options_.walk) options_.walk->restore(session_.scene);
        player_.restart();
        if (stage == Stage::walk) walk_.emplace(options_.walk->script());
        capture(false);
        session_.renderer->invalidate_history();
        std::string first = std::exchange(told_, {});
        if (stage == Stage::explore) first += (first.empty() ? "" : "\n") + std::string(help);
        say(std::move(first), help_seconds);
    }

    /// Who walks, and the light that he plays with.
    void move(const Input& input, double dt) {
        if (stage_ == Stage::title) return;
        if (!(walk_ && walk_->ending()) && player_.update(input, dt, captured_))
            session_.renderer->invalidate_history();
        if (!walk_) return;
        const bool ended = walk_->ending();
        walk_->update({.eye = player_.eye(),
                       .direction = player_.direction(),
                       .use = input.pressed(settings_.keys.use) || input.gamepad.use,
                       .lantern = input.pressed(settings_.keys.lantern) || input.gamepad.lantern},
                      dt);
        if (walk_->over()) return enter(Stage::title);
        if (walk_->ending() != ended) session_.renderer->invalidate_history();
        options_.walk->apply(session_.scene, *walk_, player_.camera_to_world(), time_);
    }

    [[nodiscard]] View view(float aspect) const {
        const float fov = glm::radians(settings_.field_of_view);
        if (stage_ == Stage::title) return swaying_view(options_.walk->script().title, time_, fov, aspect);
        if (walk_ && walk_->ending()) return swaying_view(options_.walk->script().end, time_, fov, aspect);
        return make_view(player_.camera_to_world(), fov, game_znear, aspect);
    }

    [[nodiscard]] std::optional<WalkBanner> walk_banner() const {
        if (!walk_) return std::nullopt;
        const auto named = [&](const std::string& words) { return with_keys(words, settings_.keys, by_gamepad_); };
        return WalkBanner{named(walk_->words()), named(walk_->prompt()), walk_->lit(),
                          walk_->ending() ? 0 : options_.walk->script().places.size()};
    }

    void keys(const Input& input) {
        const Input::Gamepad& pad = input.gamepad;
        if (input.keys_pressed.any()) by_gamepad_ = false;
        if (pad.jump || pad.use || pad.lantern || pad.left != glm::vec2(0)) by_gamepad_ = true;
        if (input.pressed(Key::f2)) screenshot_requested_ = true;
        if (stage_ == Stage::title) return;
        if (pad.menu) pause(!ui_.paused);
        if (ui_.wants_keyboard()) return;  // letters and digits go to a text field, any key to the player's keys
        if (input.pressed(Key::f1)) show_debug_ui(!ui_.visible);
        if (input.pressed(Key::escape)) escape();
        if (ui_.paused && input.pressed(Key::q)) session_.context->request_close();
        if (ui_.paused) return;
        if (input.pressed(Key::h)) ui_.hud_visible = !ui_.hud_visible;
        if (input.pressed(Key::v)) next_technique();
        if (stage_ == Stage::explore) explore(input);
    }

    /// What would take the walk's light or way from it.
    void explore(const Input& input) {
        if (input.pressed(Key::f) || input.gamepad.fly) {
            player_.set_flying(!player_.flying());
            say(player_.flying() ? "flying" : "walking");
        }
        if (input.pressed(Key::t)) {
            logic_.set_day_time(session_.scene, (logic_.day_time() + 1) % logic_.day_times().size());
            say("time of day: " + logic_.day_times()[logic_.day_time()].name);
        }
        if (input.pressed(Key::g)) {
            logic_.set_fog(session_.scene, (logic_.fog() + 1) % logic_.fogs().size());
            say("fog: " + logic_.fogs()[logic_.fog()].name);
        }
        for (int i = 0; i < 7; ++i)
            if (input.pressed(static_cast<Key>(static_cast<int>(Key::num_1) + i))) go_to(places[i]);
    }

    /// Out of one thing at a time: the debug window, the menu, the game into the menu.
    void escape() {
        if (ui_.visible && !captured_)
            ui_.visible = false;
        else
            pause(!ui_.paused);
    }

    /// The world stands still behind the menu.
    void pause(bool on) {
        ui_.paused = on;
        if (on)
            capture(false);
        else
            keep_settings();
    }

    void menu(const MenuRequests& requests) {
        if (requests.place) go_to(*requests.place);
        if (requests.debug_ui) show_debug_ui(true);
        if (requests.go_on || requests.place || requests.debug_ui || requests.title) pause(false);
        if (requests.title) enter(Stage::title);
        if (requests.walk) {
            enter(Stage::walk);
            capture(true);
        }
        if (requests.explore) enter(Stage::explore);
        if (requests.quit) session_.context->request_close();
    }

    void show_debug_ui(bool on) {
        ui_.visible = on;
        if (on) capture(false);
    }

    void player_changed(const PlayerSettings& before) {
        if (settings_.full_screen != before.full_screen) session_.context->set_full_screen(settings_.full_screen);
        const std::string preset = preset_of(settings_.quality);
        if (settings_.quality != before.quality && !preset.empty()) apply_preset(session_.settings, preset);
    }

    void pointer(const Input& input) {
        const bool clicked = input.buttons_pressed[static_cast<std::size_t>(MouseButton::left)];
        if (clicked && !captured_ && !ui_.paused && !ui_.title && !ui_.wants_pointer()) capture(true);
    }

    void capture(bool on) {
        captured_ = on;
        session_.context->capture_pointer(on);
    }

    void go_to(const std::string& place) {
        const Camera* camera = session_.scene.find_camera(place);
        if (camera == nullptr) return;
        const glm::mat4 pose = node_pose(session_.scene, camera->node);
        player_.place(glm::vec3(pose[3]), -glm::vec3(pose[2]));
        player_.set_flying(true);
        session_.renderer->invalidate_history();
        say(place + " (flying; F to walk)");
    }

    void next_technique() {
        const std::string next = technique_after(session_.volumetrics.settings.technique);
        session_.settings.set("technique", next);
        say("technique: " + next);
    }

    void screenshot() {
        screenshot_requested_ = false;
        const std::string name = unused_screenshot_name();
        std::string problems;
        const auto attempt = [&](const std::function<void()>& write) {
            try {
                write();
                return true;
            } catch (const Error& e) {
                problems += std::string("\n") + e.what();
                return false;
            }
        };
        if (options_.stats) attempt([&] { write_text(*options_.stats, stats()); });
        const bool saved = attempt([&] { write_image(name, screen_.read()); });
        say((saved ? "saved " + name : "not saved") + problems);
    }

    /// The nearest of the level's places, or coordinates.
    [[nodiscard]] std::string where() const {
        const glm::vec3 eye = player_.eye();
        std::string nearest;
        float best = 12.0f;  // m
        for (const std::string& place : places)
            if (const Camera* camera = session_.scene.find_camera(place)) {
                const float d = glm::length(glm::vec3(session_.scene.nodes[camera->node].world[3]) - eye);
                if (d < best) {
                    best = d;
                    nearest = place;
                }
            }
        return fmt::format("{}{}({:.0f}, {:.0f}, {:.0f})", nearest, nearest.empty() ? "" : " ", eye.x, eye.y,
                           eye.z);
    }

    void say(std::string text, double seconds = message_seconds) {
        message_ = std::move(text);
        message_seconds_left_ = seconds;
    }

    Session& session_;
    const GameOptions& options_;
    Player player_;
    LevelLogic logic_;
    DebugUi ui_;
    Screen screen_;
    float scale_;
    PlayerSettings settings_ = options_.player, kept_ = settings_;
    std::optional<FrameBudget> budget_;
    decltype(Input::keys_pressed) early_keys_ = options_.early_keys;
    Stage stage_ = Stage::explore;
    std::optional<Walk> walk_;
    bool captured_ = false, by_gamepad_ = false, screenshot_requested_ = false;
    double time_ = 0, message_seconds_left_ = 0, frame_ms_ = 0;
    Stopwatch stopwatch_;
    std::string message_, told_ = options_.told;
};

}  // namespace

std::string technique_after(const std::string& current) {
    const std::vector<std::string>& names = volumetrics::technique_names();
    auto next = std::ranges::find(names, current);
    do {
        next = next == names.end() || next + 1 == names.end() ? names.begin() : next + 1;
    } while (!volumetrics::technique(*next).traits.interactive);
    return *next;
}

void play(Session& session, const GameOptions& options) {
    Game game(session, options);
    FrameClock clock = options.fixed_step > 0 ? FrameClock::fixed(options.fixed_step) : FrameClock::wall();
    for (int i = 0; !session.context->should_close() && (options.frames == 0 || i < options.frames); ++i)
        game.frame(clock.tick());
    game.keep_settings();
    OutputFiles files;
    if (options.stats) files.add(*options.stats, game.stats());
    if (options.screenshot) files.add(*options.screenshot, encode_image(*options.screenshot, game.screen().read()));
    files.commit();
}

}  // namespace tyndall
