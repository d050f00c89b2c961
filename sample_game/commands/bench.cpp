#include "bench/bench.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>

#include "bench/suites.h"
#include "engine/core/error.h"
#include "sample_game/commands/commands.h"

namespace tyndall {

void add_bench_command(CLI::App& app) {
    auto o = std::make_shared<bench::BenchOptions>();
    auto references = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("bench", "Error against time: tables and plots of techniques and settings");
    command->add_option("--suite", o->suite, fmt::format("{}", fmt::join(bench::suite_names(), ", ")))
        ->capture_default_str();
    command->add_option("--out", o->out, "folder for measurements, tables and plots")->required();
    command->add_option("--scene", o->places, "only this place of the suite, repeatable")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--size", o->size, "pixels, WxH")->capture_default_str();
    command->add_option("--repeats", o->repeats, "timed frames of each configuration")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    auto* reference = command->add_option(
        "--reference", o->reference,
        "ground truth: cpu; gpu, the technique reference (the default of convergence); or march, "
        "the limit of ray_march (the default of what shows sampling)");
    reference->check(CLI::IsMember({"cpu", "gpu", "march"}))->capture_default_str();
    command->add_option("--references", *references, "folder of ground truths, kept (default: OUT/references)");
    command->add_option("--context", o->context, "auto, egl, osmesa or glfw")->capture_default_str();
    command->add_flag("--resume,!--no-resume", o->resume, "go on from what OUT holds (default), or begin anew");
    command->callback([o, references, reference] {
        if (reference->count() == 0) o->reference = bench::default_reference(o->suite);
        if (!references->empty()) o->references = *references;
        o->command_line = fmt::format("tyndall bench --suite {} --size {} --repeats {} --reference {}", o->suite,
                                      o->size, o->repeats, o->reference);
        for (const std::string& place : o->places) o->command_line += " --scene " + place;
        o->command_line += " --out DIR";
        bench::run_bench(*o);
    });
}

}  // namespace tyndall
