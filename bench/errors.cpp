#include "bench/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/flip.h"
#include "engine/core/image_edges.h"
#include "engine/core/image_metrics.h"

namespace tyndall::bench {
namespace {

/// The session draws the point as if it had just begun.
void start(Session& session, const View& view, const Point& point) {
    session.options.frame_index = 0;
    if (point.configuration.history_frames == 0) return;
    session.renderer->invalidate_history();
    for (int i = 0; i < point.configuration.history_frames; ++i) session.draw(view, point.place->time);
}

double count_invalid(const Image& image, float max) {
    return static_cast<double>(
        std::ranges::count_if(image.pixels, [max](float v) { return !std::isfinite(v) || v < 0 || v > max; }));
}

Image first_channel(const Image& image) {
    Image first(image.size, 1);
    for (std::size_t i = 0; i < first.pixels.size(); ++i)
        first.pixels[i] = image.pixels[i * static_cast<std::size_t>(image.channels)];
    return first;
}

std::vector<glm::vec3> switch_off(Scene& scene) {
    std::vector<glm::vec3> intensities;
    bool lamps = false;
    for (const Light& light : scene.lights) {
        intensities.push_back(light.intensity);
        lamps |= light.type != LightType::sun && light.intensity != glm::vec3(0);
    }
    for (Light& light : scene.lights)
        if (!lamps || light.type != LightType::sun) light.intensity = glm::vec3(0);
    return intensities;
}

void switch_on(Scene& scene, const std::vector<glm::vec3>& intensities) {
    for (std::size_t i = 0; i < intensities.size(); ++i) scene.lights[i].intensity = intensities[i];
}

}  // namespace

std::vector<bool> same_surface(const Image& depth, const Image& reference) {
    const auto at = [](const Image& image, std::size_t pixel) {
        return image.pixels[pixel * static_cast<std::size_t>(image.channels)];
    };
    std::vector<bool> same(reference.pixels.size() / static_cast<std::size_t>(reference.channels));
    for (std::size_t i = 0; i < same.size(); ++i)
        same[i] = std::abs(at(depth, i) - at(reference, i)) <= 0.01f * at(reference, i);
    return same;
}

Image kept(const Image& image, const std::vector<bool>& keep) {
    Image row({0, 1}, image.channels);
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        ++row.size.x;
        for (std::size_t c = i * channels; c < (i + 1) * channels; ++c) row.pixels.push_back(image.pixels[c]);
    }
    return row;
}

double dim_relative_rmse(const Image& image, const Image& reference, double part) {
    const std::size_t channels = static_cast<std::size_t>(reference.channels);
    const auto brightness = [&](std::size_t pixel) {
        const auto begin = reference.pixels.begin() + static_cast<std::ptrdiff_t>(pixel * channels);
        return *std::max_element(begin, begin + static_cast<std::ptrdiff_t>(channels));
    };
    std::vector<float> sorted(reference.pixels.size() / channels);
    for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = brightness(i);
    std::ranges::sort(sorted);
    const float limit = sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
    std::vector<bool> dim(sorted.size());
    for (std::size_t i = 0; i < dim.size(); ++i) dim[i] = brightness(i) <= limit;
    return relative_rmse(kept(image, dim), kept(reference, dim));
}

Comparison measure_errors(Session& session, const View& view, const Point& point, const GroundTruth& truth,
                          bool display) {
    start(session, view, point);
    std::vector<std::string> layers{"scattering", "depth"};
    if (display) layers.insert(layers.end(), {"transmittance", "color"});
    std::vector<Image> drawn = draw_layers(session, view, point.place->time, layers);
    const std::vector<bool> same = same_surface(drawn[1], truth.depth);
    const Image scattering = kept(drawn[0], same), reference = kept(truth.scattering, same);
    Errors errors;
    errors.masked = static_cast<double>(std::ranges::count(same, false)) / static_cast<double>(same.size());
    errors.scattering = relative_rmse(scattering, reference);
    errors.dim = dim_relative_rmse(scattering, reference, 0.98);
    errors.invalid = count_invalid(drawn[0], std::numeric_limits<float>::max());
    const Image band = edge_band(first_channel(truth.depth), 2);
    const MaskedError parts = masked_relative_rmse(scattering, reference, kept(band, same));
    errors.edge = parts.inside;
    errors.rest = parts.outside;
    if (!display) return {errors, std::move(drawn[0]), same};
    errors.transmittance = compare_images(kept(drawn[2], same), kept(truth.transmittance, same)).rmse;
    errors.invalid += count_invalid(drawn[2], 1.0f);
    const bool finite = std::ranges::all_of(drawn[3].pixels, [](float v) { return std::isfinite(v); });
    errors.flip =
        finite ? mean_value(hdr_flip_error(drawn[3], truth.color)) : std::numeric_limits<double>::infinity();
    return {errors, std::move(drawn[0]), same};
}

Motion measure_motion(Session& session, const View& view, const Point& point) {
    constexpr int frames = 8;
    const double time = point.place->time;
    const auto draw = [&] { return draw_layers(session, view, time, {"scattering"}).front(); };
    start(session, view, point);
    Motion motion;
    std::vector<Image> pictures{draw(), draw()};
    const Image on = pictures.back();
    const bool still = point.configuration.history_frames == 0 && pictures[0].pixels == on.pixels;
    while (!still && pictures.size() < frames) pictures.push_back(draw());
    if (!still) motion.flicker = flicker(pictures);

    const std::vector<glm::vec3> intensities = switch_off(session.scene);
    std::vector<Image> after{draw(), draw()};
    if (!still || after[0].pixels != after[1].pixels) {
        while (after.size() < 4) after.push_back(draw());
        for (int i = 0; i < point.configuration.history_frames; ++i) session.draw(view, time);
        const Image off = draw();
        // What leaves all media of the place out shows no light that could stay.
        for (std::size_t i = 0; off.pixels != on.pixels && i < 3; ++i)
            motion.residual[i] = residual_light(after[(1u << i) - 1], on, off);
    }
    switch_on(session.scene, intensities);
    return motion;
}

gl::WorkCounts measure_work(Session& session, const View& view, const Point& point) {
    session.options.count_work = true;
    session.draw(view, point.place->time);
    session.options.count_work = false;
    gl::WorkCounts sum{};
    for (const auto& [pass, counts] : session.renderer->work())
        if (pass.starts_with("volumetrics/"))
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += counts[i];
    return sum;
}

}  // namespace tyndall::bench
