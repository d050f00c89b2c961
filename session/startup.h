#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace tyndall {

struct StartupStage {
    std::string name;
    double ms = 0;
};

/// Where the time from the start of the program to its first frame goes.
class Startup {
  public:
    /// This is what was done since the last call, the first time since the program's start. `within` tells of a
    /// part of it, which becomes a stage of its own.
    void did(const std::string& stage, const StartupStage& within = {});
    [[nodiscard]] const std::vector<StartupStage>& stages() const { return stages_; }
    [[nodiscard]] double total_ms() const;

  private:
    static const std::chrono::steady_clock::time_point program_start;
    std::vector<StartupStage> stages_;
    std::chrono::steady_clock::time_point last_ = program_start;
};

}  // namespace tyndall
