#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/flip.h"
#include "engine/core/image.h"
#include "engine/core/image_edges.h"
#include "engine/core/image_encode.h"
#include "engine/core/image_metrics.h"
#include "engine/core/output_files.h"
#include "sample_game/commands/commands.h"
#include "session/scene_options.h"

namespace tyndall {
namespace {

const std::vector<std::string> metric_names{"rmse", "relrmse", "relmse", "psnr", "max", "flip"};
/// 10 of 255 levels, and the rounding of a difference of two.
constexpr float visible_difference = 10.0f / 255.0f + 1e-6f;
constexpr int band_radius = 3;  ///< px

struct CompareOptions {
    std::string a, b;
    std::vector<std::string> metrics;
    std::optional<std::string> heatmap, threshold, edges;
    bool json = false;
};

/// Integer formats hold display values 0..1 (sRGB encoded); floating-point ones hold radiance.
bool holds_radiance(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    return extension == ".exr" || extension == ".hdr";
}

/// Peak of the PSNR.
double peak_of(const std::string& path, const Image& reference) {
    return holds_radiance(path) ? std::max(*std::ranges::max_element(reference.pixels), 0.0f) : 1.0;
}

Image read_finite(const std::string& path) {
    Image image = read_image(path, 3);
    require_finite(image, path);
    return image;
}

Image threshold_of(const CompareOptions& o, const Image& a, const Image& b) {
    if (!holds_radiance(o.b)) return threshold_picture(a, b, visible_difference);
    const float white = display_white(b);
    return threshold_picture(radiance_to_display(a, white), radiance_to_display(b, white), visible_difference);
}

void check_pictures(const CompareOptions& o) {
    std::vector<NamedFile> inputs{{"A", o.a}, {"B", o.b}}, outputs;
    if (o.edges) inputs.push_back({"--edges", *o.edges});
    if (o.heatmap) outputs.push_back({"--heatmap", *o.heatmap});
    if (o.threshold) outputs.push_back({"--threshold", *o.threshold});
    for (const NamedFile& output : outputs) check_picture_name(output.option, output.path);
    check_outputs(outputs, inputs);
}

void run(const CompareOptions& o) {
    check_pictures(o);
    if (holds_radiance(o.a) != holds_radiance(o.b))
        throw UsageError(fmt::format(
            "cannot compare {} with {}: one holds display values, the other linear radiance", o.a, o.b));
    const std::vector<std::string>& asked = o.metrics.empty() ? metric_names : o.metrics;
    const auto wants = [&](const std::string& name) { return std::ranges::find(asked, name) != asked.end(); };
    const bool only_flip = asked.size() == 1 && wants("flip");

    const Image a = read_finite(o.a);
    const Image b = read_finite(o.b);
    const ImageDifference d = compare_images(a, b, peak_of(o.b, b));
    Image flip;
    if (wants("flip")) flip = holds_radiance(o.b) ? hdr_flip_error(a, b) : flip_error(a, b);

    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    for (const std::string& name : metric_names) {
        if (!wants(name)) continue;
        const double value = name == "rmse"      ? d.rmse
                             : name == "relrmse" ? relative_rmse(a, b)
                             : name == "relmse"  ? d.relmse
                             : name == "psnr"    ? d.psnr
                             : name == "max"     ? d.max
                                                 : mean_value(flip);
        result[name] = value;
    }
    if (o.edges) {
        const MaskedError error = masked_relative_rmse(a, b, edge_band(read_image(*o.edges, 1), band_radius));
        const std::pair<const char*, double> values[]{
            {"edges", error.inside}, {"elsewhere", error.outside}, {"edge_share", error.share}};
        for (const auto& [name, value] : values) result[name] = value;
    }
    OutputFiles files;
    if (o.heatmap)
        files.add(*o.heatmap,
                  encode_image(*o.heatmap,
                               only_flip ? flip_heatmap(flip)
                                         : difference_heatmap(a, b, static_cast<float>(std::max(d.max, 1e-12)))));
    if (o.threshold) files.add(*o.threshold, encode_image(*o.threshold, threshold_of(o, a, b)));
    files.commit();
    if (o.json)
        fmt::print("{}\n", result.dump());
    else
        for (const auto& [name, value] : result.items()) fmt::print("{:<6} {:.9g}\n", name, value.get<double>());
}

}  // namespace

void add_compare_command(CLI::App& app) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand("compare", "Error of picture A against reference B");
    command->add_option("A", options->a)->required();
    command->add_option("B", options->b)->required();
    command
        ->add_option(
            "--metric", options->metrics,
            "rmse, relrmse (over B's mean), relmse, psnr, max, flip (HDR form for .exr and .hdr); default: all")
        ->delimiter(',')
        ->check(CLI::IsMember(metric_names));
    command->add_option("--heatmap", options->heatmap,
                        "write |A-B|, or FLIP where that alone is asked for, as a picture (.png or .exr)");
    command->add_option(
        "--threshold", options->threshold,
        "write B with differences over 10/255 in red; radiance is shown sRGB encoded, white where 99 % of "
        "B's values lie below");
    command->add_option(
        "--edges", options->edges,
        "view depth (`render --layer depth`): relrmse also of the pixels within 3 px of depth edges "
        "(edges), and of all others (elsewhere)");
    command->add_flag("--json", options->json, "one JSON object; a value that is not finite is null");
    command->callback([options] { run(*options); });
}

}  // namespace tyndall
