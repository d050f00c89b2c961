#include "volumetrics/volumetrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "frame/check_inputs.h"
#include "frame/composite.h"
#include "frame/resources.h"
#include "light/sky_light.h"
#include "reconstruction/reconstruction.h"
#include "shaders/shared/bindings.h"
#include "techniques/froxel_fog.h"
#include "techniques/techniques.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {
namespace {

/// A frame's list says once of every pass why it is not there.
void skip_missing(PassList& passes, const std::vector<std::string>& names, const std::string& reason) {
    for (const std::string& name : names)
        if (std::ranges::find(passes.passes(), name, &PassList::PassInfo::name) == passes.passes().end())
            passes.skip(name, reason);
}

void skip_others(PassList& passes, const TechniqueDesc& chosen) {
    const std::string reason = "technique is " + chosen.name;
    for (const std::string& name : technique_names()) skip_missing(passes, technique(name).passes, reason);
    skip_missing(passes, reconstruction_passes(), reason);
}

}  // namespace

struct Volumetrics::Impl {
    ShaderLibrary& shaders;
    Resources resources = {};
    FrameMedia media = {};
    std::unique_ptr<Kept> kept = {};  ///< by the technique
    std::string technique = {};       ///< that keeps it
    bool count_work = false;
    bool prepared = false;            ///< since the last add_passes
    bool light_passes_added = false;  ///< since `prepare`
    glm::ivec2 size{0};               ///< of the host's picture

    void require_prepared(const char* call) const {
        if (!prepared)
            throw Error(
                fmt::format("volumetrics: {} without a prepare before it; each frame has one, and each view a "
                            "Volumetrics of its own",
                            call));
    }

    Outputs add_technique(PassList& passes, const Inputs& inputs, const Settings& settings,
                          const TechniqueDesc& desc) {
        resources.this_frame = {};
        Frame frame{passes, shaders, inputs, settings, media, resources, kept, inputs.size, inputs.depth};
        Outputs outputs;
        if (desc.traits.needs_global_medium && !media.has_global) {
            skip_missing(passes, desc.passes, "no global medium");
            resources.temporal.release();
        } else if (desc.add) {
            add_depth_downsample(frame);
            Estimate estimate = desc.add(frame);
            add_sky_light(frame, estimate);
            outputs = reconstruct(frame, estimate);
        }
        if (!inputs.transparents.empty() && !outputs.fog)
            outputs.fog = add_froxel_fog(frame, transparent_columns(frame), nullptr);
        if (inputs.transparents.empty()) resources.transparent_depths = {};
        skip_missing(
            passes, {"volumetrics/transparent_columns"},
            inputs.transparents.empty() ? "nothing transparent in view" : "froxels of all columns are there");
        skip_missing(passes, sky_light_passes(),
                     inputs.has_sky_radiance ? "nothing asks for it" : "ambient light is the same everywhere");
        skip_others(passes, desc);
        return outputs;
    }
};

Volumetrics::Volumetrics(ShaderLibrary& shaders) : impl_(std::make_unique<Impl>(Impl{shaders})) {}
Volumetrics::~Volumetrics() = default;

void Volumetrics::prepare(const Inputs& inputs, const Settings& settings) {
    if (technique(settings.technique).add && !(inputs.global.empty() && inputs.local.empty())) check_inputs(inputs);
    impl_->prepared = true;
    impl_->size = inputs.size;
    ++impl_->resources.prepared;
    impl_->media = gather_media(inputs, settings);
    impl_->light_passes_added = false;
    impl_->resources.light_volumes.prepare(inputs, settings, impl_->media);
    if (impl_->technique != settings.technique || impl_->media.empty()) impl_->kept.reset();
    impl_->technique = settings.technique;
    if (impl_->media.empty() && !impl_->resources.light_volumes.any())
        impl_->resources.release(impl_->media);
    else
        impl_->resources.upload(settings, impl_->media, impl_->shaders.roots());
}

LightTransmittance Volumetrics::add_light_passes(PassList& passes, const Inputs& inputs, const Settings& settings) {
    impl_->require_prepared("add_light_passes");
    LightVolumes& volumes = impl_->resources.light_volumes;
    impl_->light_passes_added = true;
    if (!impl_->media.attenuating.empty())
        volumes.add_passes(passes, impl_->shaders, inputs, impl_->resources.grids);
    const bool on = settings.light.transmittance && technique(settings.technique).add;
    return {.any = on && (impl_->media.has_global || volumes.any()),
            .light_volumes = volumes.axis(),
            .sun_volume = volumes.sun(),
            .grid_sun_volume = volumes.grid_suns(),
            .lamp_volumes = volumes.lamps()};
}

Outputs Volumetrics::add_passes(PassList& passes, const Inputs& inputs, const Settings& settings) {
    const TechniqueDesc& desc = technique(settings.technique);
    impl_->require_prepared("add_passes");
    impl_->count_work = inputs.count_work;
    if (!impl_->light_passes_added) add_light_passes(passes, inputs, settings);
    impl_->prepared = false;
    if (impl_->media.empty() || !averages_frames(settings)) impl_->resources.temporal.release();
    if (!desc.add || impl_->media.empty()) {
        const std::string reason = desc.add ? "no medium in view" : "technique is " + desc.name;
        skip_missing(passes, desc.passes, reason);
        if (!desc.add) skip_others(passes, desc);
        skip_missing(passes, reconstruction_passes(), reason);
        skip_missing(passes, sky_light_passes(), reason);
        passes.skip("volumetrics/composite", reason);
        return {};
    }
    check_textures(passes, inputs);
    return impl_->add_technique(passes, inputs, settings, desc);
}

TextureRef Volumetrics::composite(PassList& passes, const Outputs& outputs, TextureRef color) {
    if (!outputs.scattering) return color;
    check_color(passes, color, impl_->size);
    return add_composite(passes, impl_->shaders, impl_->resources, outputs, color, impl_->count_work);
}

void Volumetrics::sample_fog(PassBuilder& builder, const Fog& fog) {
    for (const TextureRef texture : {fog.columns, fog.radiance, fog.optical_depth}) builder.sample(texture);
}

void Volumetrics::bind_fog(const PassContext& context, const Fog& fog) const {
    bind_uniforms();
    bind_fog_textures(context, fog);
}

void Volumetrics::bind_uniforms() const {
    TYNDALL_CHECK(impl_->resources.uniforms);
    impl_->resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
    impl_->resources.light_volumes.bind();
}

void Volumetrics::forget_history() {
    impl_->kept.reset();
    impl_->resources.temporal.release();
}

std::size_t Volumetrics::persistent_bytes() const {
    return impl_->resources.bytes() + (impl_->kept ? impl_->kept->bytes() : 0);
}

}  // namespace tyndall::volumetrics
