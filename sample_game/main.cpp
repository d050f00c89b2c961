#include <fmt/format.h>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "sample_game/commands/commands.h"

int main(int argc, char** argv) {
    CLI::App app{"Tyndall: light in participating media, every technique on one scene"};
    app.require_subcommand(1);
    tyndall::init_logging();
    try {
        tyndall::add_play_command(app);
        tyndall::add_render_command(app);
        tyndall::add_reference_command(app);
        tyndall::add_compare_command(app);
        tyndall::add_flythrough_command(app);
        tyndall::add_bench_command(app);
        tyndall::add_report_command(app);
        tyndall::add_list_command(app);
        tyndall::add_inspect_command(app);
        if (argc > 1 && argv[1][0] != '-' &&
            app.get_subcommands([&](const CLI::App* c) { return c->get_name() == argv[1]; }).empty())
            throw tyndall::UsageError(fmt::format(
                "no command '{}': expected play, render, reference, compare, flythrough, bench, report, list or "
                "inspect",
                argv[1]));
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& e) {
        return app.exit(e);  // --help
    } catch (const CLI::ParseError& e) {
        fmt::print(stderr, "tyndall: {}\n", e.what());
        return 2;
    } catch (const tyndall::UsageError& e) {
        fmt::print(stderr, "tyndall: {}\n", e.what());
        return 2;
    } catch (const std::exception& e) {
        fmt::print(stderr, "tyndall: {}\n", e.what());
        return 1;
    }
}
