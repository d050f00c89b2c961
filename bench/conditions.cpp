#include "bench/conditions.h"

#include <fmt/format.h>

#include "bench/machine.h"
#include "engine/scene/data_root.h"

namespace tyndall::bench {

using nlohmann::json;

json conditions_of(const BenchOptions& options, const std::set<std::string>& scenes, const Session& session) {
    const Capabilities& driver = session.context->capabilities();
    Digest digest;
    for (const std::string& scene : scenes) digest.add_file(data_root() / scene);
    return {{"suite", options.suite},
            {"places", options.places},
            {"size", options.size},
            {"repeats", options.repeats},
            {"reference", options.reference},
            {"driver", driver.renderer},
            {"driver_version", driver.version},
            {"processor", processor_name()},
            {"version", program_version()},
            {"scene_files", digest.hex()},
            {"timing", session.timer_mode() == gl::TimerMode::query
                           ? "GPU timer queries"
                           : "wall clock from finish to finish of each pass (a software driver's queries lie)"}};
}

json told(const json& conditions, const BenchOptions& options) {
    json all = conditions;
    all["command"] = options.command_line;
    all["date"] = date_today();
    return all;
}

std::string machine_text(const json& conditions) {
    return fmt::format("{}, {}, {}", conditions["driver"].get<std::string>(), conditions["size"].get<std::string>(),
                       date_today());
}

std::string report_head(const std::string& title, const json& told) {
    const auto text = [&](const char* key) { return told.at(key).get<std::string>(); };
    return fmt::format(
        "# {}\n\nSuite `{}`, measured {}.\n\n    {}\n\n| | |\n|---|---|\n| driver | {}, {} |\n| processor | {} |\n"
        "| program | {} |\n| size | {} |\n",
        title, text("suite"), text("date"), text("command"), text("driver"), text("driver_version"),
        text("processor"), text("version"), text("size"));
}

std::string ground_truth_row(const json& told) {
    const std::string kind = told.at("reference").get<std::string>();
    return fmt::format("| ground truth | {} |\n",
                       kind == "cpu" ? "CPU: `tyndall reference`, one ray through each pixel's centre"
                       : kind == "gpu"
                           ? "GPU: technique `reference`, over the same shadow maps"
                           : "the march itself: mean of 16 frames of 128 steps (64 where lamps are many) with "
                             "Bayer 16×16 noise moved by the golden ratio, so that only errors of sampling "
                             "show; 40×24×32 froxels hold local media in all pictures");
}

}  // namespace tyndall::bench
