#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "bench/html_report.h"
#include "engine/core/files.h"
#include "sample_game/commands/commands.h"

namespace tyndall {

void add_report_command(CLI::App& app) {
    struct Options {
        std::vector<std::filesystem::path> folders;
        std::filesystem::path out = "report.html";
    };
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("report", "One HTML page of what bench measured");
    command->add_option("folders", o->folders, "what `tyndall bench --out` wrote")->required();
    command->add_option("-o,--out", o->out, "the page")->capture_default_str();
    command->callback([o] {
        const std::string page = bench::html_report(o->folders);
        write_text(o->out, page);
        fmt::print("{}\n", o->out.string());
    });
}

}  // namespace tyndall
