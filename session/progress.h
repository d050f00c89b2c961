#pragma once

#include <chrono>
#include <string>

namespace tyndall {

/// One line on a terminal's stderr: what, how far, time left. Silent when stderr is not a terminal.
class Progress {
  public:
    Progress(std::string what, int total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void step();

  private:
    std::string what_;
    int total_;
    int done_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace tyndall
