#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/core/image.h"
#include "support/command.h"

namespace tyndall::test {

/// `tyndall play` in a window, driven by real key and mouse events (xdotool). All waits have time limits and throw
/// std::runtime_error when they pass.
class GameProcess {
  public:
    /// Why it cannot run here; empty if it can.
    static std::string missing();

    /// Starts the game and waits for its first frames.
    explicit GameProcess(const std::vector<std::string>& arguments);
    ~GameProcess();
    GameProcess(const GameProcess&) = delete;
    GameProcess& operator=(const GameProcess&) = delete;

    void key(const std::string& name);  ///< press and release
    void key_down(const std::string& name);
    void key_up(const std::string& name);
    void move_pointer(int x, int y);    ///< pixels of the window from the top left
    void turn_pointer(int dx, int dy);  ///< relative, by a hand's small steps
    void click();
    void resize(int width, int height);  ///< the window
    /// While it is stopped, what is sent waits for the one poll after it goes on: a slow frame.
    void stop();
    void go_on();
    [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }  ///< where it runs

    struct State {
        nlohmann::json stats;
        Image picture;  ///< without the UI
    };
    /// Presses F2 and waits for the picture and the statistics.
    State state();
    Image picture();  ///< presses F2 and waits for the picture
    /// Asks again and again until `done` holds.
    State state_when(const std::function<bool(const State&)>& done, const std::string& what, int seconds = 25);
    /// Waits a few frames: what was sent has arrived.
    void frames(int count);

    /// Waits for the end; the exit code, or -1 for a signal.
    int wait_for_exit(int seconds = 20);
    [[nodiscard]] nlohmann::json stats() const;  ///< as last written

  private:
    void xdotool(const std::string& arguments) const;
    [[nodiscard]] bool running();

    TemporaryFolder folder_;
    pid_t pid_ = -1;
    int exit_code_ = -1;
    int pictures_ = 0;
    std::string window_;
};

}  // namespace tyndall::test
