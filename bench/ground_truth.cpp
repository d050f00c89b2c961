#include "bench/ground_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "bench/machine.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "reference/reference.h"
#include "session/progress.h"

namespace tyndall::bench {
namespace {

const std::vector<std::string> layers{"color", "scattering", "transmittance", "depth"};

std::array<Image*, 4> images(GroundTruth& truth) {
    return {&truth.color, &truth.scattering, &truth.transmittance, &truth.depth};
}

GroundTruth from_cpu(const Session& session, const View& view, const Point& point) {
    reference::Settings settings;
    settings.light_transmittance = point.light_transmittance;
    settings.ambient = session.options.render.ambient;
    settings.sky_visibility = session.options.render.sky_visibility;
    const reference::Reference integrator(session.scene, settings);
    Progress progress("reference of " + point.place->name + ", row", point.size.y);
    reference::Picture picture =
        reference::render(integrator, view, point.size, 1, 0, [&](int, int) { progress.step(); });
    return {std::move(picture.color), std::move(picture.scattering), std::move(picture.transmittance),
            std::move(picture.depth)};
}

GroundTruth from_gpu(Session& session, const View& view, const Point& point) {
    session.settings.reset_to_defaults();
    session.settings.set("technique", "reference");
    session.settings.set("light_transmittance", point.light_transmittance ? "true" : "false");
    session.size = point.size;
    session.options.frame_index = 0;
    std::vector<Image> drawn = draw_layers(session, view, point.place->time, layers);
    return {std::move(drawn[0]), std::move(drawn[1]), std::move(drawn[2]), std::move(drawn[3])};
}

constexpr double loop_limit = 65'535;  ///< iterations, after which llvmpipe ends a shader's loops

GroundTruth from_march(Session& session, const View& view, const Point& point) {
    const std::size_t lamps = session.scene.lights.size();
    session.settings.reset_to_defaults();
    session.settings.set("light_transmittance", point.light_transmittance ? "true" : "false");
    for (const char* assignment : {"technique=ray_march", "noise=bayer", "noise_size=16", "noise_time=golden_ratio",
                                   "filter=none", "resolution=full", "temporal=off"})
        session.settings.set(assignment);
    for (const std::string& assignment : few_froxels()) session.settings.set(assignment);
    session.settings.set(128.0 * static_cast<double>(lamps) < loop_limit ? "steps=128" : "steps=64");
    session.size = point.size;
    session.options.frame_index = 0;
    std::vector<Image> mean = mean_of_frames(session, view, point.place->time, layers, 16);
    return {std::move(mean[0]), std::move(mean[1]), std::move(mean[2]), std::move(mean[3])};
}

}  // namespace

const std::vector<std::string>& few_froxels() {
    static const std::vector<std::string> settings{"froxels_x=40", "froxels_y=24", "froxels_z=32"};
    return settings;
}

TruthKind truth_kind(const std::string& name) {
    TYNDALL_CHECK(name == "cpu" || name == "gpu" || name == "march");
    return name == "cpu" ? TruthKind::cpu : name == "gpu" ? TruthKind::gpu : TruthKind::march;
}

std::vector<Image> mean_of_frames(Session& session, const View& view, double time,
                                  const std::vector<std::string>& names, int frames) {
    std::vector<Image> mean = draw_layers(session, view, time, names);
    for (int frame = 1; frame < frames; ++frame) {
        const std::vector<Image> drawn = draw_layers(session, view, time, names);
        for (std::size_t i = 0; i < mean.size(); ++i)
            for (std::size_t p = 0; p < mean[i].pixels.size(); ++p)
                mean[i].pixels[p] += (drawn[i].pixels[p] - mean[i].pixels[p]) / static_cast<float>(frame + 1);
    }
    return mean;
}

std::vector<Image> draw_layers(Session& session, const View& view, double time,
                               const std::vector<std::string>& names) {
    session.options.layer = names.front();
    session.options.more_layers = {names.begin() + 1, names.end()};
    session.draw(view, time);
    std::vector<Image> drawn{session.renderer->read_layer()};
    for (const std::string& name : session.options.more_layers) drawn.push_back(session.renderer->read_layer(name));
    session.options.layer = "color";
    session.options.more_layers.clear();
    return drawn;
}

std::string GroundTruths::stem(Session& session, const Point& point) const {
    Digest digest;
    digest.add_file(session.scene.path);
    const RenderSettings& render = session.options.render;
    digest.add(
        fmt::format("{} {} {} {}", point.place->camera, point.place->time, render.ambient, render.sky_visibility));
    if (kind_ != TruthKind::cpu) {
        digest.add(session.context->capabilities().renderer);
        digest.add(program_version());
    }
    return fmt::format("{}-{}-{}", point.subject(),
                       kind_ == TruthKind::cpu   ? "cpu"
                       : kind_ == TruthKind::gpu ? "gpu"
                                                 : "march",
                       digest.hex().substr(0, 8));
}

GroundTruth GroundTruths::get(Session& session, const View& view, const Point& point) const {
    const std::string name = stem(session, point);
    std::vector<std::filesystem::path> paths;
    for (const std::string& layer : layers) paths.push_back(folder_ / (name + "-" + layer + ".exr"));
    GroundTruth truth;
    const std::array<Image*, 4> into = images(truth);
    if (std::ranges::all_of(paths, [](const auto& path) { return std::filesystem::exists(path); })) {
        for (std::size_t i = 0; i < paths.size(); ++i) *into[i] = read_image(paths[i], 3);
        return truth;
    }
    std::error_code failure;
    std::filesystem::create_directories(folder_, failure);
    if (failure) throw Error(fmt::format("{}: cannot make the folder, {}", folder_.string(), failure.message()));
    const auto start = std::chrono::steady_clock::now();
    truth = kind_ == TruthKind::cpu   ? from_cpu(session, view, point)
            : kind_ == TruthKind::gpu ? from_gpu(session, view, point)
                                      : from_march(session, view, point);
    for (std::size_t i = 0; i < paths.size(); ++i) write_image(paths[i], *into[i]);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    fmt::print(stderr, "ground truth of {}: {:.1f} s\n", point.subject(), took.count());
    return truth;
}

}  // namespace tyndall::bench
