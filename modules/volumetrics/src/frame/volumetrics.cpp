#include "volumetrics/volumetrics.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "engine/core/check.h"
#include "frame/passes.h"
#include "media/froxel_tiles.h"
#include "reconstruction/reconstruction.h"
#include "reconstruction/relight.h"
#include "reconstruction/temporal.h"
#include "shaders/shared/bindings.h"
#include "techniques/froxel_history.h"
#include "techniques/froxel_passes.h"

namespace tyndall::volumetrics {
namespace {

/// Passes that not every technique has, so that a frame's list says of each why it is not there.
const std::map<Technique, std::vector<const char*>>& passes_of() {
    static const std::map<Technique, std::vector<const char*>> names{
        {Technique::ray_march,
         {"volumetrics/inject_media", "volumetrics/froxel_runs", "volumetrics/depth_downsample",
          "volumetrics/march", "volumetrics/filter_horizontal", "volumetrics/filter_vertical",
          "volumetrics/relight", "volumetrics/upsample", "volumetrics/temporal"}},
        {Technique::froxel,
         {"volumetrics/inject_media", "volumetrics/froxel_history", "volumetrics/depth_downsample",
          "volumetrics/filter_horizontal", "volumetrics/filter_vertical", "volumetrics/upsample",
          "volumetrics/temporal"}},
        {Technique::analytic_fog, {"volumetrics/analytic_fog"}},
        {Technique::radial_shafts,
         {"volumetrics/analytic_fog", "volumetrics/radial_visibility", "volumetrics/radial_shafts",
          "volumetrics/depth_downsample", "volumetrics/filter_horizontal", "volumetrics/filter_vertical",
          "volumetrics/upsample", "volumetrics/temporal"}},
        {Technique::billboards,
         {"volumetrics/depth_downsample", "volumetrics/billboards", "volumetrics/billboards_resolve",
          "volumetrics/filter_horizontal", "volumetrics/filter_vertical", "volumetrics/upsample",
          "volumetrics/temporal"}},
        {Technique::shaft_geometry,
         {"volumetrics/depth_downsample", "volumetrics/shaft_mesh", "volumetrics/shaft_faces",
          "volumetrics/shaft_resolve", "volumetrics/filter_horizontal", "volumetrics/filter_vertical",
          "volumetrics/relight", "volumetrics/upsample", "volumetrics/temporal"}},
        {Technique::particles,
         {"volumetrics/depth_downsample", "volumetrics/particles_simulate", "volumetrics/particles",
          "volumetrics/particles_resolve", "volumetrics/filter_horizontal", "volumetrics/filter_vertical",
          "volumetrics/upsample", "volumetrics/temporal"}},
    };
    return names;
}

void skip_others(PassList& passes, Technique technique, bool fog) {
    const std::string reason = "technique is " + technique_names()[static_cast<std::size_t>(technique)];
    const auto own = passes_of().find(technique);
    std::set<std::string_view> done;
    if (fog) done = {"volumetrics/inject_media", "volumetrics/froxel_history"};  // transparents need them
    for (const auto& [other, names] : passes_of())
        for (const char* name : names) {
            const bool owned =
                own != passes_of().end() && std::ranges::count(own->second, std::string_view(name)) > 0;
            if (!owned && done.insert(name).second) passes.skip(name, reason);
        }
}

void skip_passes_of(PassList& passes, Technique technique, const std::string& reason) {
    for (const char* name : passes_of().at(technique)) passes.skip(name, reason);
}

void skip_all(PassList& passes, const std::string& reason) {
    skip_passes_of(passes, Technique::ray_march, reason);
    passes.skip("volumetrics/composite", reason);
}

}  // namespace

struct Volumetrics::Impl {
    explicit Impl(ShaderLibrary& shaders) : resources{.shaders = shaders} {}

    PassResources resources;
    FrameMedia media;
    FroxelHistory froxel_history;
    TemporalHistory temporal_history;
    std::optional<FroxelMedia> local_froxels;  ///< of this frame, once they are made
    bool count_work = false;
    bool light_passes_added = false;  ///< since `prepare`

    void release() {
        resources.light_volumes.release();
        resources.uniforms = {};
        resources.local_media = {};
        resources.media_tiles = {};
        resources.noise.release();
        resources.unfinished = {};
        resources.sprites = {};
    }

    void upload_tiles(const Settings& settings) {
        const glm::ivec3 froxels{settings.froxels_x, settings.froxels_y, settings.froxels_z};
        const std::vector<std::uint32_t> tiles = live_tiles(media.local_froxels, froxels);
        media.live_tiles = tiles.size() / (1 + (media.local_froxels.size() + 31) / 32);
        resources.media_tiles.assign(std::span<const std::uint32_t>(tiles), "volumetrics media tiles");
    }

    FroxelMedia add_local_media(PassList& passes, const Inputs& inputs, const Settings& settings) {
        local_froxels = FroxelMedia();
        if (!media.local.empty())
            local_froxels = add_inject_media(passes, resources, inputs, settings, media);
        else
            passes.skip("volumetrics/inject_media", "no local medium in view");
        if (media.local.empty() && settings.technique == Technique::ray_march)
            passes.skip("volumetrics/froxel_runs", "no local medium in view");
        return *local_froxels;
    }

    /// What transparents are fogged by where the technique has no froxels of light.
    Fog add_fog(PassList& passes, const Inputs& inputs, const Settings& settings) {
        const FroxelMedia froxels = local_froxels ? *local_froxels : add_local_media(passes, inputs, settings);
        return add_froxel_fog(passes, resources, inputs, settings, media, froxels, froxel_history);
    }

    /// What `add` draws at the chosen resolution becomes a picture.
    Outputs add_sampled(PassList& passes, const Inputs& inputs, const Settings& settings, const auto& add) {
        const Inputs low = add_depth_downsample(passes, resources, inputs, settings);
        return add_reconstruction(passes, resources, inputs, low, settings, add(low), temporal_history);
    }

    Outputs add_ray_march(PassList& passes, const Inputs& inputs, const Settings& settings) {
        const FroxelMedia froxels = add_local_media(passes, inputs, settings);
        return add_sampled(passes, inputs, settings, [&](const Inputs& low) {
            return add_march(passes, resources, low, settings, media, froxels);
        });
    }

    Outputs add_froxels(PassList& passes, const Inputs& inputs, const Settings& settings) {
        const FroxelMedia froxels = add_local_media(passes, inputs, settings);
        Fog fog;
        Outputs outputs = add_sampled(passes, inputs, settings, [&](const Inputs& low) {
            Outputs applied = add_froxel(passes, resources, inputs, low, settings, media, froxels, froxel_history);
            fog = applied.fog;
            return applied;
        });
        outputs.fog = fog;
        return outputs;
    }

    Outputs add_shafts(PassList& passes, const Inputs& inputs, const Settings& settings) {
        if (media.has_global)
            return add_sampled(passes, inputs, settings, [&](const Inputs& low) {
                return add_shaft_geometry(passes, resources, low, settings, media);
            });
        skip_passes_of(passes, Technique::shaft_geometry, "no global medium");
        temporal_history.release();
        return {};
    }

    /// The sun of the fog is all that radial_shafts adds to.
    Outputs add_radial_shafts_or_fog(PassList& passes, const Inputs& inputs, const Settings& settings) {
        if (inputs.has_sun) return add_radial_shafts(passes, resources, inputs, settings, media, temporal_history);
        for (const std::string_view name : passes_of().at(Technique::radial_shafts))
            if (name != "volumetrics/analytic_fog") passes.skip(std::string(name), "no sun");
        return add_analytic_fog(passes, resources, inputs, settings, media);
    }

    Outputs add_technique(PassList& passes, const Inputs& inputs, const Settings& settings) {
        switch (settings.technique) {
            case Technique::off:
                return {};
            case Technique::ray_march:
                return add_ray_march(passes, inputs, settings);
            case Technique::froxel:
                return add_froxels(passes, inputs, settings);
            case Technique::billboards:
                return add_sampled(passes, inputs, settings, [&](const Inputs& low) {
                    return add_billboards(passes, resources, low, settings, media);
                });
            case Technique::particles:
                return add_sampled(passes, inputs, settings, [&](const Inputs& low) {
                    return add_particles(passes, resources, low, settings, media);
                });
            case Technique::shaft_geometry:
                return add_shafts(passes, inputs, settings);
            case Technique::analytic_fog:
                return add_analytic_fog(passes, resources, inputs, settings, media);
            case Technique::radial_shafts:
                return add_radial_shafts_or_fog(passes, inputs, settings);
            case Technique::reference:
                return add_reference(passes, resources, inputs, settings, media);
        }
        return {};
    }

    void upload(const Settings& settings) {
        if (!resources.nearest.id()) {
            resources.nearest =
                gl::Sampler({.min_filter = GL_NEAREST, .mag_filter = GL_NEAREST}, "volumetrics nearest");
            resources.linear = gl::Sampler({}, "volumetrics linear");
        }
        resources.uniforms.assign(std::span<const shared::VolumetricsData>(&media.data, 1), "volumetrics uniforms");
        if (media.local.empty())
            resources.local_media = {};
        else
            resources.local_media.assign(std::span<const shared::LocalMedium>(media.local),
                                         "volumetrics local media");
        if (media.local_froxels.empty())
            resources.media_tiles = {};
        else
            upload_tiles(settings);
        if (settings.technique != Technique::reference)
            resources.unfinished = {};
        else if (!resources.unfinished)
            resources.unfinished = gl::Buffer(16, "volumetrics unfinished lamps");
        if (settings.technique != Technique::billboards && settings.technique != Technique::particles)
            resources.sprites = {};
        resources.noise.prepare(settings);
    }
};

Volumetrics::Volumetrics(ShaderLibrary& shaders) : impl_(std::make_unique<Impl>(shaders)) {}
Volumetrics::~Volumetrics() = default;

void Volumetrics::prepare(const Inputs& inputs, const Settings& settings) {
    impl_->media = gather_media(inputs, settings);
    impl_->light_passes_added = false;
    impl_->resources.light_volumes.prepare(inputs, settings, impl_->media);
    if (impl_->media.empty() && !impl_->resources.light_volumes.any())
        impl_->release();
    else
        impl_->upload(settings);
}

LightTransmittance Volumetrics::add_light_passes(PassList& passes, const Inputs& inputs, const Settings& settings) {
    LightVolumes& volumes = impl_->resources.light_volumes;
    impl_->light_passes_added = true;
    if (!impl_->media.attenuating.empty()) volumes.add_passes(passes, impl_->resources.shaders, inputs);
    const bool on = settings.light_transmittance && settings.technique != Technique::off;
    return {.any = on && (impl_->media.has_global || volumes.any()),
            .light_volumes = volumes.any(),
            .sun_volume = volumes.sun(),
            .lamp_volumes = volumes.lamps()};
}

Outputs Volumetrics::add_passes(PassList& passes, const Inputs& inputs, const Settings& settings) {
    const FrameMedia& media = impl_->media;
    impl_->count_work = inputs.count_work;
    if (!impl_->light_passes_added) add_light_passes(passes, inputs, settings);
    if (media.empty() || !averages_frames(settings)) impl_->temporal_history.release();
    if (!keeps_history(inputs, settings, media)) impl_->froxel_history.release();
    if (settings.technique == Technique::off || media.empty()) {
        skip_all(passes, settings.technique == Technique::off ? "technique is off" : "no medium in view");
        return {};
    }
    TYNDALL_CHECK(impl_->resources.uniforms);  // prepare came first
    skip_others(passes, settings.technique, inputs.transparents);
    impl_->local_froxels.reset();
    Outputs outputs = impl_->add_technique(passes, inputs, settings);
    if (inputs.transparents && !outputs.fog) outputs.fog = impl_->add_fog(passes, inputs, settings);
    return outputs;
}

TextureRef Volumetrics::composite(PassList& passes, const Outputs& outputs, TextureRef color) {
    if (!outputs.scattering) return color;
    return add_composite(passes, impl_->resources, outputs, color, impl_->count_work);
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

std::size_t Volumetrics::persistent_bytes() const {
    const PassResources& r = impl_->resources;
    return r.uniforms.size() + r.local_media.size() + r.media_tiles.size() + r.noise.bytes() + r.sprites.size() +
           impl_->froxel_history.bytes() + impl_->temporal_history.bytes() + r.light_volumes.bytes();
}

}  // namespace tyndall::volumetrics
