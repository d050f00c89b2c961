#include "bench/ticker.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace tyndall::bench {

Ticker::Ticker()
    : terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()), shown_(start_) {}

Ticker::~Ticker() {
    if (open_) fmt::print(stderr, "\n");
}

void Ticker::group(const std::string& name, int number, int count) {
    group_ = fmt::format("{}/{} {}", number, count, name);
    if (!terminal_) fmt::print(stderr, "{}{}\n", group_, left());
}

void Ticker::tick(double cost) {
    done_ += cost;
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || now - shown_ < std::chrono::milliseconds(200)) return;
    shown_ = now;
    fmt::print(stderr, "\r\x1b[K{}{}", group_, left());
    std::fflush(stderr);
    open_ = true;
}

std::string Ticker::left() const {
    if (done_ <= 0 || total_ <= 0) return "";
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const double seconds = elapsed.count() * (total_ - done_) / done_;
    const std::string time = seconds < 120    ? fmt::format("{:.0f} s", seconds)
                             : seconds < 7200 ? fmt::format("{:.0f} min", seconds / 60)
                                              : fmt::format("{:.1f} h", seconds / 3600);
    return fmt::format(", {:.0f}% done, {} left", 100 * done_ / total_, time);
}

}  // namespace tyndall::bench
