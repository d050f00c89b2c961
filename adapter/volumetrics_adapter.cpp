#include "adapter/volumetrics_adapter.h"

#include <fmt/format.h>

#include <algorithm>

#include "adapter/acceptance_view.h"
#include "engine/core/error.h"

namespace tyndall {
namespace {

volumetrics::GlobalMedium global_medium(const Medium& m) {
    return {.sigma_s = m.sigma_s,
            .sigma_a = m.sigma_a,
            .anisotropy = m.anisotropy,
            .emission = m.emission,
            .rayleigh = m.rayleigh,
            .height = m.height_profile,
            .base = m.base,
            .falloff = m.falloff};
}

volumetrics::Shape shape_of(const Medium& bounded) {
    switch (bounded.shape) {
        case Medium::Shape::sphere:
        case Medium::Shape::ellipsoid:
            return volumetrics::Shape::ellipsoid;
        case Medium::Shape::box:
            return volumetrics::Shape::box;
        case Medium::Shape::grid:
            return volumetrics::Shape::grid;
        case Medium::Shape::global:
        case Medium::Shape::height:
            break;
    }
    throw Error(fmt::format("{} medium: a bounded one expected", name_of(bounded.shape)));
}

volumetrics::Inputs view_inputs(const FrameContext& frame) {
    volumetrics::Inputs inputs;
    inputs.view = frame.view.view;
    inputs.projection = frame.view.projection;
    inputs.eye = frame.view.eye;
    inputs.znear = frame.view.znear;
    inputs.size = frame.size;
    inputs.frame_index = frame.frame_index;
    inputs.time = frame.time;
    inputs.count_work = frame.count_work;
    return inputs;
}

/// Local media out of view are given too: they may dim the light of what is in view.
void add_media(volumetrics::Inputs& inputs, const FrameContext& frame, ModuleGrids& grids) {
    grids.keep_those_of(frame.scene.media);
    for (const Medium& medium : frame.scene.media) {
        if (is_bounded(medium)) {
            volumetrics::LocalMedium& local = inputs.local.emplace_back(local_medium(medium));
            local.emission /= frame.scene.light_unit();
            if (medium.grid) set_grid(local, grids.of(medium.grid), index_to_world(medium), medium.nearest);
        } else if (frame.facts.has_global_medium) {
            inputs.global.push_back(global_medium(medium));
            inputs.global.back().emission /= frame.scene.light_unit();
        }
    }
}

void add_lights(volumetrics::Inputs& inputs, const FrameContext& frame, const LightSources& sources) {
    const FrameFacts& facts = frame.facts;
    inputs.has_sun = facts.has_sun;
    inputs.sun_direction = glm::vec3(frame.frame.sun_direction);
    const auto sun = frame.scene.sun();
    inputs.sun_shadow = frame.settings.shadows && sun && frame.scene.lights[*sun].shadow;
    inputs.has_lamps = facts.local_lights_in_view > 0;
    inputs.has_ambient = facts.has_ambient;
    inputs.has_sky_radiance = facts.sky_visibility;
    for (std::size_t i = 0; i < facts.lamps.size(); ++i) {
        const Lamp& lamp = facts.lamps[i];
        if (!lamp.in_view) continue;
        const Light& light = frame.scene.lights[lamp.light];
        inputs.lamps.push_back({.index = static_cast<std::uint32_t>(i),
                                .position = lamp.position,
                                .range = lamp.range,
                                .axis = lamp.axis,
                                .cos_outer = lamp.cos_outer,
                                .shadow = frame.settings.shadows && light.shadow,
                                .through_glass = lamp.through_glass,
                                .intensity = (light.intensity.r + light.intensity.g + light.intensity.b) / 3});
    }
    inputs.light_textures = sources.textures;
    inputs.light_buffers = sources.buffers;
    inputs.bind_lighting = sources.bind;
    inputs.sun_through_glass = facts.sun_through_glass;
    inputs.has_shadow_maps = true;
}

}  // namespace

volumetrics::LocalMedium local_medium(const Medium& bounded) {
    return {.shape = shape_of(bounded),
            .center = bounded.center,
            .half_extent = bounded.half_extent,
            .rotation = bounded.rotation,
            .softness = bounded.softness,
            .sigma_s = bounded.density * bounded.sigma_s,
            .sigma_a = bounded.density * bounded.sigma_a,
            .anisotropy = bounded.anisotropy,
            .emission = bounded.density * bounded.emission,
            .noise_scale = bounded.noise_scale,
            .noise_amount = bounded.noise_amount,
            .noise_seed = bounded.noise_seed,
            .height = bounded.height_profile,
            .base = bounded.base,
            .falloff = bounded.falloff};
}

const std::shared_ptr<const volumetrics::DensityGrid>& ModuleGrids::of(
    const std::shared_ptr<const DensityGrid>& grid) {
    auto& made = grids_[grid];
    if (!made) made = volumetrics::density_grid(grid->bricks, grid->values, grid);
    return made;
}

void ModuleGrids::keep_those_of(const std::vector<Medium>& media) {
    std::erase_if(grids_, [&](const auto& entry) {
        return std::ranges::find(media, entry.first, &Medium::grid) == media.end();
    });
}

bool VolumetricsAdapter::wants_motion(const FrameContext& frame) const {
    return frame.facts.has_medium() && volumetrics::reads_motion(settings);
}

void VolumetricsAdapter::add_before_lighting(FrameContext& frame, const GBuffer& gbuffer,
                                             std::span<const Aabb> transparents, LightSources& lights) {
    if (!module_) module_ = std::make_unique<volumetrics::Volumetrics>(frame.shaders);
    inputs_ = view_inputs(frame);
    add_media(inputs_, frame, grids_);
    add_lights(inputs_, frame, lights);
    inputs_.depth = gbuffer.depth;
    inputs_.motion = gbuffer.motion;
    for (const Aabb& box : transparents) inputs_.transparents.push_back({box.min, box.max});
    inputs_.acceptance = show_acceptance || std::ranges::count(frame.layers, "acceptance") > 0;
    inputs_.samples = std::ranges::count(frame.layers, "samples") > 0;
    module_->prepare(inputs_, settings);
    const volumetrics::LightTransmittance dimmed = module_->add_light_passes(frame.passes, inputs_, settings);
    if (!dimmed.any) return;
    for (const TextureRef volume : {dimmed.sun_volume, dimmed.grid_sun_volume, dimmed.lamp_volumes})
        if (volume) lights.textures.push_back(volume);
    lights.defines["MEDIUM_TRANSMITTANCE"] = inputs_.has_sun || inputs_.has_lamps;
    lights.defines["LIGHT_VOLUMES"] = dimmed.light_volumes;
    lights.bind = [this, bind = lights.bind] {
        bind();
        module_->bind_uniforms();
    };
}

TextureRef VolumetricsAdapter::add_after_lighting(FrameContext& frame, TextureRef color) {
    outputs_ = module_->add_passes(frame.passes, inputs_, settings);
    return module_->composite(frame.passes, outputs_, color);
}

FrameModule::Transparents VolumetricsAdapter::transparents() const {
    if (!outputs_.fog) return {};
    return {.declare = [fog = outputs_.fog](PassBuilder& pass) { volumetrics::Volumetrics::sample_fog(pass, fog); },
            .bind = [this](const PassContext& pass) { module_->bind_fog(pass, outputs_.fog); },
            .defines = {{"FOG", 1}}};
}

TextureRef VolumetricsAdapter::add_display(FrameContext& frame, TextureRef display) {
    if (!show_acceptance || !outputs_.acceptance) return {};
    return add_acceptance_view(frame, outputs_.acceptance, display);
}

std::vector<Layer> VolumetricsAdapter::layers() const {
    const bool in_alpha = !outputs_.transmittance;
    return {{.name = "scattering", .texture = outputs_.scattering, .is_light = true},
            {.name = "transmittance",
             .texture = in_alpha ? outputs_.scattering : outputs_.transmittance,
             .decode = in_alpha ? Layer::alpha : Layer::rgb,
             .absent = 1},
            {.name = "acceptance", .texture = outputs_.acceptance, .decode = acceptance_picture},
            {.name = "samples", .texture = outputs_.samples}};
}

void VolumetricsAdapter::forget_history() {
    if (module_) module_->forget_history();
}

std::size_t VolumetricsAdapter::persistent_bytes() const {
    return module_ ? module_->persistent_bytes() : 0;
}

}  // namespace tyndall
