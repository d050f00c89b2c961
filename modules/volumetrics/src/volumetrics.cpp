#include "volumetrics/volumetrics.h"

#include <tuple>

#include "dither.h"
#include "engine/core/check.h"
#include "froxel_tiles.h"
#include "passes.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {
namespace {

constexpr const char* inject_pass = "volumetrics/inject_media";
constexpr const char* composite_pass = "volumetrics/composite";

constexpr const char* march_pass = "volumetrics/march";
constexpr const char* blur_passes[] = {"volumetrics/blur_horizontal", "volumetrics/blur_vertical"};

void skip_all(PassList& passes, const std::string& reason) {
    for (const char* name : {inject_pass, march_pass, blur_passes[0], blur_passes[1], composite_pass})
        passes.skip(name, reason);
}

}  // namespace

struct Volumetrics::Impl {
    explicit Impl(ShaderLibrary& shaders)
        : resources{.shaders = shaders,
                    .nearest = {},
                    .linear = {},
                    .uniforms = {},
                    .local_media = {},
                    .media_tiles = {},
                    .dither = {},
                    .unfinished = {}} {}

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
    if (settings.technique == Technique::reference) {
        for (const char* name : {inject_pass, march_pass, blur_passes[0], blur_passes[1]})
            passes.skip(name, "technique is reference");
        return add_reference(passes, impl_->resources, inputs, settings, media);
    }
    FroxelMedia froxels;
    if (media.local.empty())
        passes.skip(inject_pass, "no local medium in view");
    else
        froxels = add_inject_media(passes, impl_->resources, inputs, settings, media);
    if (settings.technique == Technique::froxel) {
        for (const char* name : {march_pass, blur_passes[0], blur_passes[1]})
            passes.skip(name, "technique is froxel");
        return add_froxel(passes, impl_->resources, inputs, settings, media, froxels);
    }
    Outputs outputs = add_march(passes, impl_->resources, inputs, settings, media, froxels);
    if (settings.blur != Blur::none) return add_blur(passes, impl_->resources, inputs, settings, outputs);
    for (const char* name : blur_passes) passes.skip(name, "blur is none");
    return outputs;
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
