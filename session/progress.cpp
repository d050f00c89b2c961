#include "session/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace tyndall {

Progress::Progress(std::string what, int total)
    : what_(std::move(what)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
    if (terminal_ && done_ > 0) fmt::print(stderr, "\n");
}

void Progress::step() {
    ++done_;
    if (!terminal_) return;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const double left = elapsed.count() / done_ * (total_ - done_);
    fmt::print(stderr, "\r{} {}/{}, {:.0f} s left   ", what_, done_, total_, left);
    std::fflush(stderr);
}

}  // namespace tyndall
