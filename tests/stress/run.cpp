#include "run.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/core/error.h"
#include "engine/scene/data_root.h"

namespace tyndall::stress {
namespace {

/// Where along a ray the media are sampled depends on where it ends: only closed forms are monotonic for certain.
bool has_monotonic_transmittance(const StressFrame& frame) {
    return std::ranges::none_of(frame.media, is_bounded);
}

bool has_surface(const Image& depth) {
    return std::ranges::any_of(depth.pixels, [](float d) { return d > 0; });
}

}  // namespace

Run::Run(std::uint64_t seed) : seed_(seed), shaders_(data_root()), worlds_(shaders_), compare_(shaders_) {}

Layers Run::render(const StressFrame& frame, World world) {
    auto& [scene, volumetrics, renderer] = worlds_[world];
    volumetrics->settings = frame.options.volumetrics;
    const Scene posed = pose_scene(scene, frame);
    renderer->render(posed, frame.view, frame.size, frame.options);
    return read_layers(*renderer, posed);
}

void Run::draw(int number) {
    const StressFrame frame = make_frame(seed_, number);
    if (frame.cut) worlds_[frame.world].renderer->invalidate_history();
    (void)render(frame, frame.world);
}

Findings Run::check(int number) {
    StressFrame frame = make_frame(seed_, number);
    Findings findings;
    try {
        if (frame.cut) worlds_[frame.world].renderer->invalidate_history();
        const Layers layers = render(frame, frame.world);
        check_values(layers, most_light(frame), findings);
        if (frame.comparable) compare_.check(frame, Random{seed_, 4, static_cast<std::uint64_t>(number)}, findings);
        if (number % sequence_length == 1) compare_.check_doubled(frame, findings);
        const volumetrics::Settings& v = frame.options.volumetrics;
        const bool of_own_ray = v.filter.kernel == volumetrics::Filter::none &&
                                v.temporal.mode == volumetrics::Temporal::off &&
                                v.resolution.size == volumetrics::Resolution::full;
        if (of_own_ray && has_surface(layers.depth) && has_monotonic_transmittance(frame)) {
            const Layers sky = render(frame, World::nothing);
            totals.depth_pixels += check_monotonic(layers, sky, frame.options.volumetrics.march.steps, findings);
        }
    } catch (const Error& error) {
        findings.push_back(error.what());
    }
    check_gl(findings);
    ++totals.frames;
    totals.failed += findings.empty() ? 0 : 1;
    return findings;
}

bool Run::fails_alone(int number) {
    Run alone(seed_);
    for (int before = number - number % sequence_length; before < number; ++before) alone.draw(before);
    return !alone.check(number).empty();
}

}  // namespace tyndall::stress
