#include "sample_game/game.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/log.h"
#include "engine/platform/frame_clock.h"
#include "sample_game/level_logic.h"
#include "sample_game/player.h"
#include "sample_game/ui/debug_ui.h"

namespace tyndall {
namespace {

constexpr float game_yfov = 1.05f;  // 60 degrees
constexpr float game_znear = 0.08f;
constexpr double message_seconds = 2.5;
const std::array<std::string, 6> places{"LocalPM", "Close", "LocalLights", "Sun", "Depth", "Balance"};

class Game {
  public:
    explicit Game(Session& session)
        : session_(session), player_(session.scene), logic_(session.scene), ui_(*session.shaders) {
        session.timer->set_mode(session.timer_mode());
    }

    void frame(double dt) {
        GlContext& context = *session_.context;
        const Input& input = context.input();
        context.poll();
        session_.size = glm::max(context.framebuffer_size(), glm::ivec2(1));
        if (!ui_.wants_keyboard()) keys(input);
        pointer(input);
        player_.update(ui_.wants_keyboard() ? Input{} : input, dt, captured_);

        time_ += dt;
        session_.shaders->reload_changed();
        animate(session_.scene, time_);
        const float aspect = static_cast<float>(session_.size.x) / static_cast<float>(session_.size.y);
        session_.draw(make_view(player_.camera_to_world(), game_yfov, game_znear, aspect), time_);
        if (screenshot_requested_) screenshot();

        frame_ms_ += (dt * 1e3 - frame_ms_) * 0.1;
        DebugUi::Hud hud{where(), frame_ms_, time_ < message_until_ ? message_ : std::string{}};
        const DebugUi::Requests requests = ui_.frame(session_, logic_, hud, dt, !captured_);
        screenshot_requested_ = requests.screenshot;
        context.present(session_.renderer->display_framebuffer(), session_.renderer->size());
    }

  private:
    void keys(const Input& input) {
        if (input.pressed(Key::f1)) {
            ui_.visible = !ui_.visible;
            if (ui_.visible) capture(false);
        }
        if (input.pressed(Key::f2)) screenshot_requested_ = true;
        if (input.pressed(Key::h)) ui_.hud_visible = !ui_.hud_visible;
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
        if (input.pressed(Key::v)) next_technique();
        for (int i = 0; i < 6; ++i)
            if (input.pressed(static_cast<Key>(static_cast<int>(Key::num_1) + i))) go_to(places[i]);
        if (input.pressed(Key::escape)) {
            if (captured_)
                capture(false);
            else
                session_.context->request_close();
        }
    }

    void pointer(const Input& input) {
        const bool clicked = input.buttons_pressed[static_cast<std::size_t>(MouseButton::left)];
        if (clicked && !captured_ && !ui_.wants_pointer()) capture(true);
    }

    void capture(bool on) {
        captured_ = on;
        session_.context->capture_pointer(on);
    }

    void go_to(const std::string& place) {
        const Camera* camera = session_.scene.find_camera(place);
        if (camera == nullptr) return;
        const glm::mat4& pose = session_.scene.nodes[camera->node].world;
        player_.place(glm::vec3(pose[3]), -glm::vec3(pose[2]));
        player_.set_flying(true);
        session_.renderer->invalidate_history();
        say(place + " (flying; F to walk)");
    }

    void next_technique() {
        const std::vector<std::string>& names = volumetrics::technique_names();
        const auto current = static_cast<std::size_t>(session_.options.volumetrics.technique);
        session_.settings.set("technique", names[(current + 1) % names.size()]);
    }

    void screenshot() {
        screenshot_requested_ = false;
        const std::string name = fmt::format("tyndall-{:03}.png", ++screenshots_);
        try {
            write_image(name, session_.renderer->read_display());
            say("saved " + name);
        } catch (const Error& e) {
            say(e.what());
        }
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
        return fmt::format("{}{}({:.1f}, {:.1f}, {:.1f})", nearest, nearest.empty() ? "" : " ", eye.x, eye.y,
                           eye.z);
    }

    void say(std::string text) {
        message_ = std::move(text);
        message_until_ = time_ + message_seconds;
    }

    Session& session_;
    Player player_;
    LevelLogic logic_;
    DebugUi ui_;
    bool captured_ = false, screenshot_requested_ = false;
    int screenshots_ = 0;
    double time_ = 0, message_until_ = 0, frame_ms_ = 16;
    std::string message_;
};

}  // namespace

void play(Session& session, const GameOptions& options) {
    Game game(session);
    FrameClock clock = options.fixed_step > 0 ? FrameClock::fixed(options.fixed_step) : FrameClock::wall();
    for (int i = 0; !session.context->should_close() && (options.frames == 0 || i < options.frames); ++i)
        game.frame(clock.tick());
    if (options.screenshot) write_image(*options.screenshot, session.renderer->read_display());
}

}  // namespace tyndall
