#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "sample_game/commands/commands.h"

namespace tyndall {
namespace {

struct Options {
    std::string a, b;
    std::vector<std::string> metrics;
    std::optional<std::string> heatmap;
    bool json = false;
};

/// Integer formats hold display values 0..1; floating-point ones hold radiance whose peak is the picture's own.
double peak_of(const std::string& path, const Image& reference) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension != ".exr" && extension != ".hdr") return 1.0;
    float peak = 0;
    for (int y = 0; y < reference.size.y; ++y)
        for (int x = 0; x < reference.size.x; ++x)
            for (int c = 0; c < 3; ++c) peak = std::max(peak, reference.at(x, y)[c]);
    return peak;
}

void run(const Options& o) {
    const Image a = read_image(o.a, 4);
    const Image b = read_image(o.b, 4);
    const ImageDifference d = compare_images(a, b, peak_of(o.b, b));
    const std::vector<std::pair<std::string, double>> known{
        {"rmse", d.rmse}, {"relmse", d.relmse}, {"psnr", d.psnr}, {"max", d.max}};

    nlohmann::json result = nlohmann::json::object();
    for (const auto& [name, value] : known) {
        if (!o.metrics.empty() && std::find(o.metrics.begin(), o.metrics.end(), name) == o.metrics.end()) continue;
        result[name] = value;
        if (!o.json) fmt::print("{:<7}{:.9g}\n", name, value);
    }
    if (o.json) fmt::print("{}\n", result.dump());
    if (o.heatmap) write_image(*o.heatmap, difference_heatmap(a, b, static_cast<float>(std::max(d.max, 1e-12))));
}

}  // namespace

void add_compare_command(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("compare", "Error of picture A against reference B");
    command->add_option("A", options->a)->required();
    command->add_option("B", options->b)->required();
    command->add_option("--metric", options->metrics, "rmse, relmse, psnr, max (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember({"rmse", "relmse", "psnr", "max"}));
    command->add_option("--heatmap", options->heatmap, "write |A-B| as a picture (.png or .exr)");
    command->add_flag("--json", options->json, "one JSON object; a value that is not finite is null");
    command->callback([options] { run(*options); });
}

}  // namespace tyndall
