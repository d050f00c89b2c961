#include "volumetrics/volumetrics.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "dither.h"
#include "engine/core/check.h"
#include "froxel_tiles.h"
#include "passes.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {
namespace {

/// Passes that not every technique has, so that a frame's list says of each why it is not there.
const std::map<Technique, std::vector<const char*>>& passes_of() {
    static const std::map<Technique, std::vector<const char*>> names{
        {Technique::ray_march,
         {"volumetrics/inject_media", "volumetrics/march", "volumetrics/blur_horizontal",
          "volumetrics/blur_vertical"}},
        {Technique::froxel, {"volumetrics/inject_media"}},
    };
    return names;
}

void skip_others(PassList& passes, Technique technique) {
    const std::string reason = "technique is " + technique_names()[static_cast<std::size_t>(technique)];
    const auto own = passes_of().find(technique);
    std::set<std::string_view> done;
    for (const auto& [other, names] : passes_of())
        for (const char* name : names) {
            const bool owned =
                own != passes_of().end() && std::ranges::count(own->second, std::string_view(name)) > 0;
            if (!owned && done.insert(name).second) passes.skip(name, reason);
        }
}

void skip_all(PassList& passes, const std::string& reason) {
    for (const char* name : passes_of().at(Technique::ray_march)) passes.skip(name, reason);
    passes.skip("volumetrics/composite", reason);
}

}  // namespace

struct Volumetrics::Impl {
    explicit Impl(ShaderLibrary& shaders) : resources{.shaders = shaders} {}

    PassResources resources;
    FrameMedia media;
    std::tuple<Dither, int> dither_key{};
    bool count_work = false;

    void release() {
        resources.uniforms = {};
        resources.local_media = {};
        resources.media_tiles = {};
        resources.dither = {};
        resources.unfinished = {};
    }

    void upload_tiles(const Settings& settings) {
        const glm::ivec3 froxels{settings.froxels_x, settings.froxels_y, settings.froxels_z};
        const std::vector<std::uint32_t> tiles = live_tiles(media.local_froxels, froxels);
        media.live_tiles = tiles.size() / (1 + (media.local_froxels.size() + 31) / 32);
        resources.media_tiles.assign(std::span<const std::uint32_t>(tiles), "volumetrics media tiles");
    }

    FroxelMedia add_local_media(PassList& passes, const Inputs& inputs, const Settings& settings) {
        if (!media.local.empty()) return add_inject_media(passes, resources, inputs, settings, media);
        passes.skip("volumetrics/inject_media", "no local medium in view");
        return {};
    }

    Outputs add_ray_march(PassList& passes, const Inputs& inputs, const Settings& settings) {
        const FroxelMedia froxels = add_local_media(passes, inputs, settings);
        const Outputs outputs = add_march(passes, resources, inputs, settings, media, froxels);
        if (settings.blur != Blur::none) return add_blur(passes, resources, inputs, settings, outputs);
        for (const char* name : {"volumetrics/blur_horizontal", "volumetrics/blur_vertical"})
            passes.skip(name, "blur is none");
        return outputs;
    }

    Outputs add_technique(PassList& passes, const Inputs& inputs, const Settings& settings) {
        switch (settings.technique) {
            case Technique::off:
                return {};
            case Technique::ray_march:
                return add_ray_march(passes, inputs, settings);
            case Technique::froxel: {
                const FroxelMedia froxels = add_local_media(passes, inputs, settings);
                return add_froxel(passes, resources, inputs, settings, media, froxels);
            }
            case Technique::billboards:
                return add_billboards(passes, resources, inputs, settings, media);
            case Technique::particles:
                return add_particles(passes, resources, inputs, settings, media);
            case Technique::shaft_geometry:
                return add_shaft_geometry(passes, resources, inputs, settings, media);
            case Technique::analytic_fog:
                return add_analytic_fog(passes, resources, inputs, settings, media);
            case Technique::radial_shafts:
                return add_radial_shafts(passes, resources, inputs, settings, media);
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
        const std::tuple key(settings.dither, settings.dither == Dither::none ? 1 : settings.dither_size);
        if (!resources.dither || key != dither_key) {
            const std::vector<float> tile = dither_tile(settings.dither, settings.dither_size);
            resources.dither = gl::Buffer::of(std::span<const float>(tile), "volumetrics dither tile");
            dither_key = key;
        }
    }
};

Volumetrics::Volumetrics(ShaderLibrary& shaders) : impl_(std::make_unique<Impl>(shaders)) {}
Volumetrics::~Volumetrics() = default;

void Volumetrics::prepare(const Inputs& inputs, const Settings& settings) {
    impl_->media = gather_media(inputs, settings);
    if (impl_->media.empty())
        impl_->release();
    else
        impl_->upload(settings);
}

Outputs Volumetrics::add_passes(PassList& passes, const Inputs& inputs, const Settings& settings) {
    const FrameMedia& media = impl_->media;
    impl_->count_work = inputs.count_work;
    if (settings.technique == Technique::off || media.empty()) {
        skip_all(passes, settings.technique == Technique::off ? "technique is off" : "no medium in view");
        return {};
    }
    TYNDALL_CHECK(impl_->resources.uniforms);  // prepare came first
    skip_others(passes, settings.technique);
    return impl_->add_technique(passes, inputs, settings);
}

TextureRef Volumetrics::composite(PassList& passes, const Outputs& outputs, TextureRef color) {
    if (!outputs.scattering) return color;
    return add_composite(passes, impl_->resources, outputs, color, impl_->count_work);
}

void Volumetrics::bind_uniforms() const {
    TYNDALL_CHECK(impl_->resources.uniforms);
    impl_->resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
}

std::size_t Volumetrics::persistent_bytes() const {
    const PassResources& r = impl_->resources;
    return r.uniforms.size() + r.local_media.size() + r.media_tiles.size() + r.dither.size();
}

}  // namespace tyndall::volumetrics
