#include "compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "around.h"
#include "bounds.h"
#include "draw_scene.h"
#include "moderate.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/sky_model.glsl"
TYNDALL_GLSL_END

namespace tyndall::stress {
namespace {

constexpr const char* limit_white =
    "limit: light 16 stops above white is cut off before filters, means and up-sampling take their share of it";
constexpr const char* limit_sky =
    "limit: a sky 16 stops above white is cut off where it is stored, so that its light cannot be doubled";
constexpr const char* limit_emission = "limit: local emission of 65504 a metre is cut off in froxels";
constexpr const char* dark = "dark: no light, so that it is certain that there is none and nothing else";
constexpr int pixels_per_frame = 4;
constexpr double least_light = 1e-5;  // of half floats

double mean_of(const Image& image) {
    double sum = 0;
    for (const float v : image.pixels) sum += v;
    return sum / static_cast<double>(image.pixels.size());
}

/// Local media somewhere shine more than a half float holds, or close to it, with what they absorb held there.
bool exceeds_froxels(const Medium& medium, float light_unit) {
    constexpr float noise = 2;
    const glm::vec3 sigma_t = medium.sigma_s + medium.sigma_a, emission = 2.0f / light_unit * medium.emission;
    const float lowest = medium.center.y - glm::length(medium.half_extent);
    const float density = noise * (medium.height_profile ? std::exp((medium.base - lowest) / medium.falloff) : 1);
    const float densest = std::max({sigma_t.x, sigma_t.y, sigma_t.z}) * density,
                brightest = std::max({emission.x, emission.y, emission.z}) * density;
    return is_bounded(medium) && brightest / std::max(densest / half_max, 1.0f) > 0.9f * half_max;
}

/// The sky is brightest where the sun stands, or over the horizon below which it stands.
bool exceeds_sky(const Scene& scene, float ambient) {
    const auto index = scene.sun();
    if (!index || ambient == 0) return false;
    const glm::vec3 to_sun = glm::normalize(glm::vec3(node_pose(scene, scene.lights[*index].node)[2]));
    const glm::vec3 brightest = glm::normalize(glm::vec3(to_sun.x, std::max(to_sun.y, 0.01f), to_sun.z));
    const float lux = glm::dot(scene.lights[*index].intensity, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    const glm::vec3 radiance = glsl::sky_radiance(brightest, to_sun, lux) / scene.light_unit();
    return std::max({radiance.x, radiance.y, radiance.z}) > 0.9f * half_max;
}

/// "scattering, local media".
std::string what(const std::string& layer, const StressFrame& frame) {
    const bool local =
        std::ranges::any_of(frame.media, is_bounded) && knows(frame.options.volumetrics.technique).local;
    return layer + (local ? ", local media" : "");
}

/// The worst pixel of one comparison.
struct Worst {
    explicit Worst(double most_held) : most(most_held) {}
    double most;  ///< that the layer can hold
    int pixels = 0;
    double error = 0;  ///< over its bound
    std::string said;

    void add(const char* layer, glm::ivec2 pixel, const float* value, const dvec3& right, const Bound& bound,
             double floor) {
        ++pixels;
        for (int c = 0; c < 3; ++c) {
            const double allowed = bound.relative * right[c] + floor;
            const double off = std::abs(value[c] - std::min(right[c], most)) / allowed;
            if (off <= error) continue;
            error = std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
            said = fmt::format(
                "{} at pixel ({}, {}) channel {} is {}, the ground truth {} with a bound of {:.2g} on "
                "the error",
                layer, pixel.x, pixel.y, c, value[c], right[c], allowed);
        }
    }
    void report(const std::string& technique, const std::string& name, Tally& tally, Findings& findings) const {
        tally.add(technique, name, pixels, error);
        if (error > 1) findings.push_back(said);
    }
};

void compare_with_truth(const StressFrame& frame, const Truth& truth, const Layers& layers, Random& random,
                        Tally& tally, Findings& findings) {
    const double mean = mean_of(layers.scattering);
    Worst transmittance(1), open(most_light(frame));
    double shadow_error = 0, light = 0;
    int shadow_pixels = 0;
    for (int i = 0; i < pixels_per_frame; ++i) {
        const glm::ivec2 at(random.below(frame.size.x), random.below(frame.size.y));
        const Truth::Pixel pixel = truth.trace(at);
        const Bound t = transmittance_bound(frame, truth, pixel);
        const Bound s = scattering_bound(frame, truth, pixel);
        if (t.rule.empty())
            transmittance.add("transmittance", at, layers.transmittance.at(at.x, at.y), pixel.open.transmittance, t,
                              t.floor);
        else
            tally.leave_out(t.rule, 1);
        if (!s.rule.empty()) {
            tally.leave_out(s.rule, 1);
            continue;
        }
        const float* value = layers.scattering.at(at.x, at.y);
        if (!truth.has_shadows()) {
            open.add("scattering", at, value, pixel.open.scattering, s, s.floor * mean + least_light);
            if (pixel.open.scattering == dvec3(0)) {
                --open.pixels;
                tally.leave_out(dark, 1);
            }
            continue;
        }
        const dvec3 right = truth.shadowed(pixel.ray);
        if (pixel.open.scattering == dvec3(0))
            tally.leave_out(dark, 1);
        else
            ++shadow_pixels;
        for (int c = 0; c < 3; ++c) {
            const double off = std::abs(value[c] - std::min(right[c], open.most));
            shadow_error += std::max(off - least_light, 0.0);
            light += pixel.open.scattering[c];
        }
    }
    const std::string technique = frame.options.volumetrics.technique;
    transmittance.report(technique, what("transmittance", frame), tally, findings);
    open.report(technique, what("scattering", frame), tally, findings);
    if (shadow_pixels == 0 || light == 0) return;
    const double error = shadow_error / light / shadow_bound(frame);
    tally.add(technique, what("scattering with shadows", frame), shadow_pixels, error);
    if (error > 1)
        findings.push_back(
            fmt::format("scattering with shadows is off by {:.3g} of the unshadowed light in the mean "
                        "of {} pixels, {:.2g} allowed",
                        shadow_error / light, shadow_pixels, shadow_bound(frame)));
}

/// Of particles it is that of local media in the mean alone: they are as few as they are drawn here.
void compare_mean_transmittance(const StressFrame& frame, const Truth& truth, const Layers& layers, Tally& tally,
                                Findings& findings) {
    dvec3 value(0), right(0);
    int pixels = 0;
    for (int y = 0; y < frame.size.y; ++y)
        for (int x = y % 2; x < frame.size.x; x += 2, ++pixels) {
            const float* t = layers.transmittance.at(x, y);
            value += dvec3(t[0], t[1], t[2]);
            right += truth.transmittance({x, y});
        }
    double worst = 0;
    for (int c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(value[c] - right[c]) / (0.01 * pixels + 0.1 * (pixels - right[c])));
    tally.add(frame.options.volumetrics.technique, what("mean transmittance", frame), pixels, worst);
    if (worst > 1)
        findings.push_back(fmt::format(
            "mean transmittance is {:.3f} {:.3f} {:.3f}, the ground truth {:.3f} {:.3f} {:.3f}", value.x / pixels,
            value.y / pixels, value.z / pixels, right.x / pixels, right.y / pixels, right.z / pixels));
}

void compare_with_plain(const StressFrame& frame, const std::vector<Layers>& plain, const Layers& layers,
                        Tally& tally, Findings& findings) {
    static constexpr const char* names[] = {"plain", "filter", "history", "low resolution"};
    const std::string name = names[static_cast<int>(frame.feature)];
    double worst = 0;
    std::string said;
    const std::string rule = light_differs_from_plain(frame);
    if (!rule.empty()) tally.leave_out(rule, layers.depth.size.x * layers.depth.size.y);
    for (Image Layers::*layer : {&Layers::scattering, &Layers::transmittance}) {
        if (layer == &Layers::scattering && !rule.empty()) continue;
        std::string where;
        const double off = compare_around(around(frame, plain, layer), layers.*layer, where);
        if (off <= worst) continue;
        worst = off;
        said = fmt::format("{} of {} at {}", layer == &Layers::scattering ? "scattering" : "transmittance", name,
                           where);
    }
    tally.add(frame.options.volumetrics.technique, what(name, frame), layers.depth.size.x * layers.depth.size.y,
              worst);
    if (worst > 1) findings.push_back(said);
}

}  // namespace

std::vector<Layers> Compare::draw(const StressFrame& frame, const Scene& scene, const StressOptions& options,
                                  int frames) {
    Worlds::Place& place = worlds_[frame.world];
    Renderer& renderer = *place.renderer;
    place.volumetrics->settings = options.volumetrics;
    renderer.invalidate_history();
    std::vector<Layers> all;
    for (int i = 0; i < frames; ++i) {
        StressOptions next = options;
        next.frame_index += static_cast<std::uint32_t>(i);
        renderer.render(scene, frame.view, frame.size, next);
        all.push_back(read_layers(renderer, scene));
    }
    return all;
}

void Compare::check(const StressFrame& frame, Random random, Findings& findings) {
    const Scene scene = pose_scene(worlds_[frame.world].scene, frame);
    const bool featured = frame.feature != Feature::plain;
    const bool history = frame.feature == Feature::history;
    const int frames = history ? history_frames : 1;
    const std::vector<Layers> plain_frames = draw(frame, scene, plain(frame.options), frames);
    const std::vector<Layers> drawn = featured ? draw(frame, scene, frame.options, frames) : plain_frames;
    const Truth truth(frame, scene);
    const bool exact = filters_shares(frame) || (history && holds_froxels(frame.options.volumetrics.technique));
    compare_with_truth(frame, truth, exact ? drawn.back() : plain_frames.back(), random, tally, findings);
    if (frame.options.volumetrics.technique == "particles")
        compare_mean_transmittance(frame, truth, plain_frames.back(), tally, findings);
    if (!featured) return;
    const std::string rule = differs_from_plain(frame, truth.has_shadows());
    if (rule.empty())
        compare_with_plain(frame, plain_frames, drawn.back(), tally, findings);
    else
        tally.leave_out(rule, frame.size.x * frame.size.y);
}

void Compare::check_doubled(const StressFrame& frame, Findings& findings) {
    Scene scene = pose_scene(worlds_[frame.world].scene, frame);
    if (std::ranges::any_of(scene.media, [&](const Medium& m) { return exceeds_froxels(m, scene.light_unit()); })) {
        tally.leave_out(limit_emission, frame.size.x * frame.size.y);
        return;
    }
    const Layers once = draw(frame, scene, frame.options, 1).back();
    for (Light& light : scene.lights) light.intensity *= 2;
    for (Medium& medium : scene.media) medium.emission *= 2;
    if (exceeds_sky(scene, frame.options.render.ambient)) {
        tally.leave_out(limit_sky, frame.size.x * frame.size.y);
        return;
    }
    const Layers twice = draw(frame, scene, frame.options, 1).back();
    const int pixels = frame.size.x * frame.size.y;
    const float brightest = std::ranges::max(twice.scattering.pixels);
    const volumetrics::Settings& v = frame.options.volumetrics;
    const bool of_shares = v.filter.kernel != volumetrics::Filter::none ||
                           v.temporal.mode != volumetrics::Temporal::off ||
                           v.resolution.size != volumetrics::Resolution::full || holds_froxels(v.technique);
    constexpr float least_share = 1.0f / 225;  // of the widest filter's pixels
    if (brightest > (of_shares ? 0.9f * least_share : 0.9f) * half_max) {
        tally.leave_out(limit_white, pixels);
        return;
    }
    Worst worst(most_light(frame));
    const double mean = mean_of(once.scattering);
    // The sky of a night without a moon is no light that is doubled (shaders/engine/sky_model.glsl). Light of two
    // bands through a narrow lobe may be a quarter above the brightest (shaders/lib/sky_radiance.glsl).
    const double night = 1.25 * 3.2e-4 * double(frame.options.render.ambient) / double(scene.light_unit());
    for (int i = 0; i < pixels; ++i) {
        const glm::ivec2 at(i % frame.size.x, i / frame.size.x);
        const float* value = once.scattering.at(at.x, at.y);
        worst.add("twice the light", at, twice.scattering.at(at.x, at.y), 2.0 * dvec3(value[0], value[1], value[2]),
                  {1e-3, 0}, 1e-3 * mean + 1e-4 + night);
    }
    worst.report(frame.options.volumetrics.technique, what("doubled light", frame), tally, findings);
}

}  // namespace tyndall::stress
