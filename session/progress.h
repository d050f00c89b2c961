#pragma once

#include <chrono>
#include <string>

namespace tyndall {

/// One line on a terminal's stderr: what, how far, time left. Where stderr is not a terminal it is silent or, with
/// `lines`, writes such a line every ten seconds.
class Progress {
  public:
    Progress(std::string what, int total, bool lines = false);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void step();
    /// The steps begin now: what was done before does not count for the time left.
    void begin() { start_ = Clock::now(); }
    /// A line that stays, where there are lines at all.
    void note(const std::string& text);

  private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    int total_;
    int done_ = 0;
    bool terminal_, lines_;
    Clock::time_point start_, last_line_;
};

}  // namespace tyndall
