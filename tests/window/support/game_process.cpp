#include "support/game_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace tyndall::test {
namespace {

using Clock = std::chrono::steady_clock;

std::string output_of(const std::string& command) {
    std::string text;
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("popen failed");
    std::array<char, 256> buffer{};
    while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) text += buffer.data();
    pclose(pipe);
    return text;
}

/// Asks every 50 ms.
void wait_until(const std::function<bool()>& done, const std::string& what, int seconds) {
    const auto deadline = Clock::now() + std::chrono::seconds(seconds);
    while (!done()) {
        if (Clock::now() > deadline) throw std::runtime_error(fmt::format("after {} s: no {}", seconds, what));
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

}  // namespace

std::string GameProcess::missing() {
    const char* display = std::getenv("DISPLAY");
    if (display == nullptr || *display == '\0') return "no DISPLAY";
    if (std::system("command -v xdotool >/dev/null 2>&1") != 0) return "xdotool is not installed";
    if (std::system("xdotool getdisplaygeometry >/dev/null 2>&1") != 0) return "the DISPLAY does not answer";
    return {};
}

GameProcess::GameProcess(const std::vector<std::string>& arguments) {
    std::vector<std::string> words{TYNDALL_BINARY, "play"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.insert(words.end(), {"--stats", "stats.json"});
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ == 0) {
        if (chdir(folder_.path().c_str()) != 0) _exit(126);
        setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
        dup2(open("log.txt", O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        execv(TYNDALL_BINARY, argv.data());
        _exit(127);
    }
    const auto find_window = [&] {
        window_ = output_of(fmt::format("xdotool search --onlyvisible --pid {} 2>/dev/null | head -n 1", pid_));
        if (!window_.empty()) window_.pop_back();  // the line's end
        return !window_.empty();
    };
    wait_until([&] { return !running() || find_window(); }, "window", 20);
    if (window_.empty())
        throw std::runtime_error("the game ended at once: " + output_of("cat " + (folder_ / "log.txt").string()));
    xdotool("windowfocus " + window_);
    state();
}

GameProcess::~GameProcess() {
    if (!running()) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
}

bool GameProcess::running() {
    if (pid_ < 0) return false;
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == 0) return true;
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    pid_ = -1;
    return false;
}

void GameProcess::xdotool(const std::string& arguments) const {
    if (std::system(("xdotool " + arguments).c_str()) != 0) throw std::runtime_error("xdotool " + arguments);
}

void GameProcess::key(const std::string& name) {
    xdotool("key " + name);
}
void GameProcess::key_down(const std::string& name) {
    xdotool("keydown " + name);
}
void GameProcess::key_up(const std::string& name) {
    xdotool("keyup " + name);
}
void GameProcess::move_pointer(int x, int y) {
    xdotool(fmt::format("mousemove --window {} {} {}", window_, x, y));
}
void GameProcess::turn_pointer(int dx, int dy) {
    for (int i = 0; i < 10; ++i) xdotool(fmt::format("mousemove_relative -- {} {}", dx / 10, dy / 10));
}
void GameProcess::click() {
    xdotool("click 1");
}

void GameProcess::resize(int width, int height) {
    xdotool(fmt::format("windowsize {} {} {}", window_, width, height));
}

void GameProcess::stop() {
    kill(pid_, SIGSTOP);
}
void GameProcess::go_on() {
    kill(pid_, SIGCONT);
}

Image GameProcess::picture() {
    key("F2");
    const std::filesystem::path picture = folder_ / fmt::format("tyndall-{:03}.png", ++pictures_);
    wait_until([&] { return !running() || std::filesystem::exists(picture); }, "picture after F2", 25);
    return read_image(picture);
}

GameProcess::State GameProcess::state() {
    const Image seen = picture();
    return {stats(), seen};
}

GameProcess::State GameProcess::state_when(const std::function<bool(const State&)>& done, const std::string& what,
                                           int seconds) {
    State s;
    wait_until(
        [&] {
            s = state();
            return done(s);
        },
        what, seconds);
    return s;
}

void GameProcess::frames(int count) {
    for (int i = 0; i < count; ++i) state();
}

int GameProcess::wait_for_exit(int seconds) {
    wait_until([&] { return !running(); }, "end of the game", seconds);
    return exit_code_;
}

nlohmann::json GameProcess::stats() const {
    std::ifstream file(folder_ / "stats.json");
    return nlohmann::json::parse(file);
}

}  // namespace tyndall::test
