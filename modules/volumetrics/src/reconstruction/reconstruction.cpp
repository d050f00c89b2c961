#include "reconstruction/reconstruction.h"

#include <algorithm>

#include "volumetrics/technique.h"

namespace tyndall::volumetrics {
namespace {

constexpr const char* not_sampled = "pixels sample nothing";

/// Of an estimate those sampled as much as `least`; all, if that is exact.
std::vector<TextureRef*> textures_of(Estimate& estimate, Sampling least) {
    std::vector<TextureRef*> textures;
    const auto add = [&](TextureRef& texture, Sampling sampling) {
        if (texture && sampling >= least) textures.push_back(&texture);
    };
    add(estimate.scattering, estimate.sampling);
    add(estimate.transmittance, estimate.sampling);
    for (Part& part : estimate.parts) {
        add(part.light, Sampling::exact);
        add(part.share, part.sampling);
    }
    return textures;
}

void filter(Frame& frame, Estimate& estimate, TextureRef frames) {
    const std::vector<TextureRef*> noisy = textures_of(estimate, Sampling::per_pixel);
    if (frame.settings.filter.kernel != Filter::none && !noisy.empty()) return add_filter(frame, noisy, frames);
    for (const char* name : {"volumetrics/filter_horizontal", "volumetrics/filter_vertical"})
        frame.skip(name, frame.settings.filter.kernel == Filter::none ? "filter is none" : not_sampled);
}

void upsample(Frame& frame, Estimate& estimate) {
    std::vector<TextureRef*> low = textures_of(estimate, Sampling::exact);
    std::erase_if(low, [&](const TextureRef* texture) {
        return glm::ivec2(frame.passes.desc(*texture).size) == frame.inputs.size;
    });
    if (!low.empty())
        add_upsample(frame, low);
    else
        frame.skip("volumetrics/upsample", "resolution is full");
}

}  // namespace

const std::vector<std::string>& reconstruction_passes() {
    static const std::vector<std::string> names{
        "volumetrics/depth_downsample", "volumetrics/temporal", "volumetrics/filter_horizontal",
        "volumetrics/filter_vertical",  "volumetrics/upsample", "volumetrics/refine_mask",
        "volumetrics/refine",           "volumetrics/relight"};
    return names;
}

const char* reason_for_no_parts(const Settings& settings) {
    if (settings.filter.reconstruct == Reconstruct::light) return "reconstruct is light";
    const bool none = settings.filter.kernel == Filter::none && settings.temporal.mode == Temporal::off;
    return none ? "nothing filters visibility" : nullptr;
}

bool averages_frames(const Settings& settings) {
    return settings.temporal.mode != Temporal::off &&
           technique(settings.technique).traits.sampling != Sampling::exact;
}

bool reads_motion(const Settings& settings) {
    return averages_frames(settings) && settings.temporal.mode != Temporal::blend;
}

int resolution_factor(const Settings& settings) {
    const bool any = technique(settings.technique).traits.any_resolution;
    return any ? 1 << static_cast<int>(settings.resolution.size) : 1;
}

std::string name_after(const std::string& pass, const PassList::TextureInfo& source) {
    return pass + source.name.substr(source.name.rfind('/'));
}

TextureRef create_like(Frame& frame, const std::string& pass, TextureRef source, glm::ivec2 size) {
    const PassList::TextureInfo info = frame.passes.info(source);
    return frame.passes.create(name_after(pass, info), {.format = info.desc.format, .size = {size, 1}});
}

Outputs reconstruct(Frame& frame, Estimate estimate) {
    Outputs outputs{.samples = estimate.samples, .fog = estimate.fog};
    if (!estimate) return outputs;
    const Settings& settings = frame.settings;
    const std::vector<TextureRef*> sampled = textures_of(estimate, Sampling::per_frame);
    const bool temporal = settings.temporal.mode != Temporal::off && !sampled.empty();
    const bool before = temporal && settings.temporal.place == TemporalPlace::before;
    if (!temporal)
        frame.skip("volumetrics/temporal",
                   settings.temporal.mode == Temporal::off ? "temporal is off" : not_sampled);
    TemporalMean mean;
    if (before) mean = add_temporal(frame, sampled);
    const bool narrows = settings.filter.narrows && settings.temporal.mode == Temporal::accumulate;
    filter(frame, estimate, narrows ? mean.frames : TextureRef{});
    const Estimate low = estimate;
    upsample(frame, estimate);
    add_refine(frame, low, estimate);
    if (temporal && !before) mean = add_temporal(frame, sampled);
    if (!estimate.parts.empty()) add_relight(frame, estimate);
    outputs.scattering = estimate.scattering;
    outputs.transmittance = estimate.transmittance;
    outputs.acceptance = mean.acceptance;
    return outputs;
}

}  // namespace tyndall::volumetrics
