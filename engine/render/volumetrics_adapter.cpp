#include "engine/render/volumetrics_adapter.h"

#include <fmt/format.h>

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
        case Medium::Shape::global:
        case Medium::Shape::height:
            break;
    }
    throw Error(fmt::format("{} medium: a bounded one expected", name_of(bounded.shape)));
}

volumetrics::LocalMedium local_medium(const Medium& m) {
    return {.shape = shape_of(m),
            .center = m.center,
            .half_extent = m.half_extent,
            .rotation = m.rotation,
            .softness = m.softness,
            .sigma_s = m.sigma_s,
            .sigma_a = m.sigma_a,
            .anisotropy = m.anisotropy,
            .emission = m.emission,
            .noise_scale = m.noise_scale,
            .noise_amount = m.noise_amount,
            .noise_seed = m.noise_seed,
            .height = m.height_profile,
            .base = m.base,
            .falloff = m.falloff};
}

}  // namespace

volumetrics::Inputs volumetrics_inputs(const FrameContext& frame) {
    volumetrics::Inputs inputs;
    inputs.view = frame.view.view;
    inputs.projection = frame.view.projection;
    inputs.eye = frame.view.eye;
    inputs.znear = frame.view.znear;
    inputs.size = frame.size;
    for (const Medium& medium : frame.scene.media) {
        if (is_bounded(medium))
            inputs.local.push_back(local_medium(medium));
        else if (frame.facts.has_global_medium)
            inputs.global.push_back(global_medium(medium));
    }
    inputs.has_sun = frame.facts.has_sun;
    inputs.sun_direction = glm::vec3(frame.frame.sun_direction);
    inputs.has_lamps = frame.facts.local_lights_in_view > 0;
    inputs.has_ambient = frame.facts.has_ambient;
    inputs.frame_index = frame.frame_index;
    inputs.time = frame.time;
    inputs.count_work = frame.count_work;
    return inputs;
}

void add_lighting_inputs(volumetrics::Inputs& inputs, const LightSources& sources, const LightSet& lights,
                         TextureRef depth) {
    inputs.depth = depth;
    for (const std::size_t i : lights.indices_in_view()) {
        const shared::GpuLight& light = lights.lights()[i];
        const bool spot = light.direction_type.w == static_cast<float>(LIGHT_SPOT);
        inputs.lamps.push_back({.index = static_cast<std::uint32_t>(i),
                                .position = glm::vec3(light.position_range),
                                .range = light.position_range.w,
                                .axis = glm::vec3(light.direction_type),
                                .cos_outer = spot ? -light.cone_shadow.y / light.cone_shadow.x : -1.0F});
    }
    inputs.light_textures = sources.textures;
    inputs.light_buffers = sources.buffers;
    inputs.bind_lighting = sources.bind;
}

}  // namespace tyndall
