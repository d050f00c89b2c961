#include "session/startup.h"

namespace tyndall {

const std::chrono::steady_clock::time_point Startup::program_start = std::chrono::steady_clock::now();

void Startup::did(const std::string& stage, const StartupStage& within) {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    if (!within.name.empty()) stages_.push_back(within);
    stages_.push_back({stage, ms - within.ms});
}

double Startup::total_ms() const {
    double sum = 0;
    for (const StartupStage& stage : stages_) sum += stage.ms;
    return sum;
}

}  // namespace tyndall
