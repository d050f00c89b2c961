#include "session/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace tyndall {
namespace {

constexpr std::chrono::seconds between_lines{10};

}  // namespace

Progress::Progress(std::string what, int total, bool lines)
    : what_(std::move(what)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      lines_(lines),
      start_(Clock::now()),
      last_line_(start_) {}

Progress::~Progress() {
    if (terminal_ && done_ > 0) fmt::print(stderr, "\n");
}

void Progress::step() {
    ++done_;
    const Clock::time_point now = Clock::now();
    if (!terminal_ && (!lines_ || now - last_line_ < between_lines)) return;
    last_line_ = now;
    const std::chrono::duration<double> elapsed = now - start_;
    const double left = elapsed.count() / done_ * (total_ - done_);
    const std::string text = fmt::format("{} {}/{}, {:.0f} s left", what_, done_, total_, left);
    fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", text, terminal_ ? "   " : "\n");
    std::fflush(stderr);
}

void Progress::note(const std::string& text) {
    if (!terminal_ && !lines_) return;
    last_line_ = Clock::now();
    fmt::print(stderr, "{}{}{}\n", terminal_ ? "\r" : "", text, terminal_ ? "   " : "");
}

}  // namespace tyndall
