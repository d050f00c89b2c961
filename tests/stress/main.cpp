// tyndall_stress: random and extreme frames, checked after each; the same command draws the same frames.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>

#include "describe.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/platform/gl_context.h"
#include "run.h"

namespace tyndall::stress {
namespace {

struct Options {
    int frames = 2000, first = 0, only = -1, most_failures = 10;
    std::uint64_t seed = 1;
    bool verbose = false;
    std::vector<std::string> where;
};

/// All frames of a sequence are as its first one in what is asked for.
bool wanted(const Options& options, int number) {
    const StressFrame frame = make_frame(options.seed, number - number % sequence_length);
    return std::ranges::all_of(options.where, [&](const auto& condition) { return has(frame, condition); });
}

std::string where(const Options& options) {
    std::string all;
    for (const std::string& condition : options.where) all += " --where " + condition;
    return all;
}

/// What to type to see the failure again.
std::string command(const Options& options, const std::string& program, const std::string& frames) {
    const char* data = std::getenv("TYNDALL_DATA");
    return fmt::format("{}{} --seed {} {}", data != nullptr ? fmt::format("TYNDALL_DATA={} ", data) : "", program,
                       options.seed, frames);
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

int run(const Options& options, const std::string& program) {
    const bool one = options.only >= 0;
    const int first = one ? options.only : options.first, frames = one ? 1 : options.frames;
    const auto begin = std::chrono::steady_clock::now();
    init_logging();
    spdlog::set_level(spdlog::level::err);  // the driver's messages are findings
    const auto context = create_context({});
    Run run(options.seed);
    for (int before = first - first % sequence_length; before < first; ++before) run.draw(before);
    // A condition that no frame meets ends after the frames that it may look through.
    const int end = first + (options.where.empty() ? frames : 100 * frames);
    for (int number = first;
         number < end && run.totals.frames < frames && run.totals.failed < options.most_failures; ++number) {
        if (!one && !wanted(options, number)) continue;
        const auto frame_begin = std::chrono::steady_clock::now();
        const Findings findings = run.check(number);
        if (one) fmt::print("frame {}:\n{}", number, describe(make_frame(options.seed, number)));
        if (options.verbose) fmt::print("frame {}: {:.1f} ms\n", number, 1e3 * seconds_since(frame_begin));
        if (findings.empty()) continue;
        const bool alone = one || run.fails_alone(number);
        const std::string again =
            command(options, program,
                    alone ? fmt::format("--only {}", number)
                          : fmt::format("--first {} --frames {}{}", first, run.totals.frames, where(options)));
        for (const std::string& finding : findings) fmt::print("frame {}: {}; {}\n", number, finding, again);
    }
    const Totals& t = run.totals;
    fmt::print("{}{} frames, {} failed, in {:.1f} s; {} pixels compared with what lies behind them\n",
               run.tally().table(), t.frames, t.failed, seconds_since(begin), t.depth_pixels);
    if (t.frames >= 200 && (t.depth_pixels == 0 || run.tally().pixels() == 0)) {
        fmt::print("nothing was compared\n");
        return 1;
    }
    if (t.frames < frames && t.failed == 0) {
        fmt::print("{} frames of {} were found for{}\n", t.frames, frames, where(options));
        return 1;
    }
    return t.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace tyndall::stress

int main(int argc, char** argv) {
    using namespace tyndall;
    stress::Options options;
    CLI::App app("Random and extreme frames, each checked: finite, in range, monotonic, near the ground truth.");
    app.add_option("--frames", options.frames, "how many")->check(CLI::PositiveNumber);
    app.add_option("--seed", options.seed, "of everything random");
    app.add_option("--first", options.first, "number of the first frame")->check(CLI::NonNegativeNumber);
    app.add_option("--only", options.only, "number of the only frame")->check(CLI::NonNegativeNumber);
    app.add_option("--failures", options.most_failures, "stop after so many")->check(CLI::PositiveNumber);
    app.add_option(
        "--where", options.where,
        "KEY=VALUE: only sequences whose first frame has this setting, or feature: plain, filter, history "
        "or low_resolution, which are compared with the ground truth, or extreme");
    app.add_flag("--verbose", options.verbose, "the time of each frame");
    try {
        app.parse(argc, argv);
        return stress::run(options, argv[0]);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    } catch (const std::exception& e) {
        fmt::print(stderr, "tyndall_stress: {}\n", e.what());
        return 1;
    }
}
