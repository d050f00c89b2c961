#include "engine/render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/gl/framebuffer.h"
#include "engine/gl/readback.h"
#include "engine/render/frame_context.h"
#include "engine/render/layers.h"
#include "engine/render/light_set.h"
#include "engine/render/passes/acceptance_view.h"
#include "engine/render/passes/cluster.h"
#include "engine/render/passes/depth_pyramid.h"
#include "engine/render/passes/gbuffer.h"
#include "engine/render/passes/lighting.h"
#include "engine/render/passes/shadow_atlas.h"
#include "engine/render/passes/shadow_sun.h"
#include "engine/render/passes/sky.h"
#include "engine/render/passes/tonemap.h"
#include "engine/render/passes/transparent.h"
#include "engine/render/volumetrics_adapter.h"
#include "shaders/shared/bindings.h"
#include "volumetrics/volumetrics.h"

namespace tyndall {

struct Renderer::Impl {
    explicit Impl(ShaderLibrary& library)
        : shaders(library),
          volumetrics(std::make_unique<volumetrics::Volumetrics>(library)),
          shadow_sun(library),
          shadow_atlas(library) {}

    ShaderLibrary& shaders;
    std::unique_ptr<GpuScene> scene;
    std::unique_ptr<volumetrics::Volumetrics> volumetrics;
    LightSet lights;
    ShadowSunPass shadow_sun;
    ShadowAtlasPass shadow_atlas;
    GBufferPass gbuffer;
    ClusterPass cluster;
    SkyPass sky;
    TransparentPass transparent;

    TransientPool pool;
    PassList passes;
    gl::WorkCounters counters;
    bool counted = false;
    std::vector<gl::GpuTimer::Scope> timings;
    FrameFacts facts;
    gl::Buffer frame_block;
    gl::Texture color, display;
    gl::Framebuffer display_framebuffer;
    std::optional<glm::mat4> previous_view_projection;  ///< of the frame before, if this one continues it
    float znear = 0.1f;
    struct Layer {
        gl::TextureView texture;
        bool in_alpha = false;
    };
    std::map<std::string, Layer> layers;  ///< those that were asked for
    std::string layer;

    void resize(glm::ivec2 size);
    [[nodiscard]] shared::FrameData frame_data(const FrameContext& frame) const;
    LightSources add_lights(FrameContext& frame, const GBuffer& g, const ShadowSunPass::Output& sun);
    void add_passes(FrameContext& frame, LightSources& sources, const FrameOptions& options);
    void export_layer(const std::string& name, TextureRef ref);
    void execute(const shared::FrameData& frame, const FrameOptions& options);
};

void Renderer::Impl::resize(glm::ivec2 size) {
    if (color && color.size() == size) return;
    previous_view_projection.reset();
    const glm::ivec3 extent(size, 1);
    color = gl::Texture({gl::TextureKind::d2, GL_RGBA16F, extent, 1}, "color");
    display = gl::Texture({gl::TextureKind::d2, GL_RGBA8, extent, 1}, "display");
    const gl::Attachment attachment{display};
    display_framebuffer = gl::Framebuffer(std::span(&attachment, 1), nullptr, "display");
}

shared::FrameData Renderer::Impl::frame_data(const FrameContext& frame) const {
    const View& view = frame.view;
    const glm::vec2 size(frame.size);
    shared::FrameData data{};
    data.view = view.view;
    data.projection = view.projection;
    data.view_projection = view.view_projection;
    data.inverse_view = glm::inverse(view.view);
    data.inverse_projection = glm::inverse(view.projection);
    data.inverse_view_projection = data.inverse_view * data.inverse_projection;
    data.eye = glm::vec4(view.eye, static_cast<float>(frame.time));
    data.viewport = glm::vec4(size, 1.0f / size);
    if (facts.has_sun) {
        const Light& sun = frame.scene.lights[*frame.scene.sun()];
        const glm::mat4& world = frame.scene.nodes[static_cast<std::size_t>(sun.node)].world;
        data.sun_direction = glm::vec4(-glm::normalize(glm::vec3(world[2])), 1);
        data.sun_illuminance = glm::vec4(sun.intensity, 0);
    }
    data.exposure = glm::vec4(exposure_factor(frame.scene.exposure_ev100, frame.settings.exposure_bias),
                              frame.settings.ambient, 0, 0);
    set_cluster_grid(data, frame.settings, view.znear, lights.lights().size());
    return data;
}

/// Lamps and sky: everything that lights surfaces and media.
LightSources Renderer::Impl::add_lights(FrameContext& frame, const GBuffer& g, const ShadowSunPass::Output& sun) {
    PassList& passes = frame.passes;
    LightSources sources;
    const auto sample = [&](TextureRef texture) {
        if (texture) sources.textures.push_back(texture);
    };
    const bool lamps = facts.local_lights_in_view > 0;
    if (lamps) {
        TextureRef pyramid;
        if (frame.settings.occlusion_culling)
            pyramid = add_depth_pyramid(frame, g.depth);
        else
            passes.skip("depth_pyramid", "occlusion culling is off");
        const ClusterPass::Output clusters = cluster.add(frame, lights, pyramid);
        const ShadowAtlasPass::Output shadows = shadow_atlas.add(frame, lights.in_view());
        lights.set_shadow_tiles([this](std::size_t light) { return shadow_atlas.first_tile(light); });
        lights.upload();
        sample(shadows.atlas);
        sources.buffers = {clusters.ranges, clusters.lights};
        if (shadows.tiles) sources.buffers.push_back(shadows.tiles);
    } else {
        for (const char* name : {"depth_pyramid", "light_cull", "cluster", "shadow_atlas"})
            passes.skip(name, "no lamp in view");
    }
    const SkyPass::Output dome = sky.add(frame);
    sources.sky = dome.radiance;
    sample(sun.cascades);
    sample(sun.static_map);
    if (facts.has_ambient) sample(dome.irradiance);
    sources.bind = [this, lamps] {
        frame_block.bind(GL_UNIFORM_BUFFER, BINDING_FRAME);
        if (facts.has_sun) shadow_sun.bind();
        if (facts.has_ambient) sky.bind_ambient();
        if (!lamps) return;
        lights.bind();
        cluster.bind();
        shadow_atlas.bind();
    };
    return sources;
}

void Renderer::Impl::add_passes(FrameContext& frame, LightSources& sources, const FrameOptions& options) {
    const ShadowSunPass::Output sun = shadow_sun.add(frame);
    const bool motion = facts.has_medium() && volumetrics::reads_motion(options.volumetrics);
    const GBuffer g = gbuffer.add(frame, motion ? previous_view_projection : std::nullopt);
    sources = add_lights(frame, g, sun);

    volumetrics::Inputs media = volumetrics_inputs(frame);
    add_lighting_inputs(media, sources, lights, g.depth);
    media.motion = g.motion;
    media.transparents = transparent.gather(frame);
    media.acceptance = options.show_acceptance || layers.contains("acceptance");
    volumetrics->prepare(media, options.volumetrics);
    const volumetrics::LightTransmittance transmittance =
        volumetrics->add_light_passes(passes, media, options.volumetrics);
    if (transmittance.any) {
        sources.light_volumes = transmittance.light_volumes;
        for (const TextureRef volume : {transmittance.sun_volume, transmittance.lamp_volumes})
            if (volume) sources.textures.push_back(volume);
        sources.medium_transmittance = true;
        sources.bind = [this, bind = sources.bind] {
            bind();
            volumetrics->bind_uniforms();
        };
    }

    TextureRef radiance = passes.import("color", color);
    radiance = add_lighting(frame, g, sources, radiance);
    radiance = sky.add_background(frame, {sources.sky, {}}, g.depth, radiance);
    const volumetrics::Outputs media_light = volumetrics->add_passes(passes, media, options.volumetrics);
    radiance = volumetrics->composite(passes, media_light, radiance);
    radiance = transparent.add(frame, g, sources, *volumetrics, media_light.fog, radiance);
    const TextureRef screen = passes.import("display", display);
    passes.export_texture(radiance);
    passes.export_texture(options.show_acceptance && media_light.acceptance
                              ? add_acceptance_view(frame, media_light.acceptance, screen)
                              : add_tonemap(frame, radiance, screen));

    const TextureRef transmitted = media_light.transmittance ? media_light.transmittance : media_light.scattering;
    const std::pair<const char*, TextureRef> refs[] = {{"color", radiance},
                                                       {"scattering", media_light.scattering},
                                                       {"transmittance", transmitted},
                                                       {"depth", g.depth},
                                                       {"albedo", g.albedo},
                                                       {"normal", g.normal},
                                                       {"emissive", g.emissive},
                                                       {"acceptance", media_light.acceptance}};
    for (const auto& [name, ref] : refs)
        if (layers.contains(name)) export_layer(name, ref);
    if (layers.contains("transmittance")) layers["transmittance"].in_alpha = !media_light.transmittance;
}

/// A pass that runs last and remembers the texture: nothing later takes its memory.
void Renderer::Impl::export_layer(const std::string& name, TextureRef ref) {
    if (name == "color") layers[name].texture = color;
    if (!ref || name == "color") return;
    passes.add(
        "export/" + name,
        [&](PassBuilder& pass) {
            pass.sample(ref);
            pass.keep();
        },
        [this, name, ref](const PassContext& pass) { layers[name].texture = pass.texture(ref); });
}

void Renderer::Impl::execute(const shared::FrameData& frame, const FrameOptions& options) {
    passes.compile();
    frame_block.assign(std::span(&frame, 1), "frame");
    frame_block.bind(GL_UNIFORM_BUFFER, BINDING_FRAME);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    counted = options.count_work;
    if (counted) counters.begin_frame();
    if (options.timer != nullptr) options.timer->begin_frame();
    passes.execute(pool, options.timer, counted ? &counters : nullptr);
    timings = options.timer != nullptr ? options.timer->results() : std::vector<gl::GpuTimer::Scope>();
}

Renderer::Renderer(ShaderLibrary& shaders) : impl_(std::make_unique<Impl>(shaders)) {}
Renderer::~Renderer() = default;

void Renderer::prepare(const Scene& scene, float anisotropy) {
    impl_->scene = std::make_unique<GpuScene>(scene, anisotropy);
    impl_->previous_view_projection.reset();
}

void Renderer::render(const Scene& scene, const View& view, glm::ivec2 size, const FrameOptions& options) {
    Impl& r = *impl_;
    TYNDALL_CHECK(r.scene);
    r.layers.clear();
    std::vector<std::string> wanted = options.more_layers;
    wanted.push_back(options.layer);
    for (const std::string& name : wanted) {
        if (std::ranges::count(layer_names(), name) == 0)
            throw UsageError(fmt::format("layer '{}': expected one of {}", name, fmt::join(layer_names(), ", ")));
        r.layers[name] = {};
    }
    r.resize(size);
    r.scene->update(scene);
    r.layer = options.layer;
    r.znear = view.znear;
    r.facts = compute_facts(scene, view);
    r.facts.has_ambient = r.facts.has_sun && options.render.ambient > 0;
    r.lights.update(scene, Frustum::from(view.view_projection));
    r.passes = PassList();

    shared::FrameData data{};
    FrameContext frame{.scene = scene,
                       .gpu = *r.scene,
                       .view = view,
                       .facts = r.facts,
                       .settings = options.render,
                       .shaders = r.shaders,
                       .passes = r.passes,
                       .frame = data,
                       .size = size,
                       .time = options.time,
                       .frame_index = options.frame_index,
                       .count_work = options.count_work};
    data = r.frame_data(frame);
    LightSources sources;
    r.add_passes(frame, sources, options);
    r.execute(data, options);
    r.previous_view_projection = view.view_projection;
}

void Renderer::invalidate_history() {
    impl_->volumetrics = std::make_unique<volumetrics::Volumetrics>(impl_->shaders);
    impl_->previous_view_projection.reset();
}

glm::ivec2 Renderer::size() const {
    return impl_->color.size();
}
GLuint Renderer::display_framebuffer() const {
    return impl_->display_framebuffer.id();
}
gl::TextureView Renderer::display() const {
    return impl_->display;
}
gl::TextureView Renderer::color() const {
    return impl_->color;
}
Image Renderer::read_display() const {
    return gl::read_texture(impl_->display);
}
Image Renderer::read_layer() const {
    return read_layer(impl_->layer);
}
Image Renderer::read_layer(const std::string& name) const {
    TYNDALL_CHECK(impl_->layers.contains(name));
    const Impl::Layer& layer = impl_->layers.at(name);
    return decode_layer(name, layer.texture, {impl_->color.size(), impl_->znear, layer.in_alpha});
}
const std::vector<std::string>& Renderer::layer_names() {
    static const std::vector<std::string> names{"color",  "scattering", "transmittance", "depth",
                                                "albedo", "normal",     "emissive",      "acceptance"};
    return names;
}
const FrameFacts& Renderer::facts() const {
    return impl_->facts;
}
const PassList& Renderer::passes() const {
    return impl_->passes;
}
const std::vector<gl::GpuTimer::Scope>& Renderer::timings() const {
    return impl_->timings;
}
std::vector<std::pair<std::string, gl::WorkCounts>> Renderer::work() const {
    return impl_->counted ? impl_->counters.read() : std::vector<std::pair<std::string, gl::WorkCounts>>();
}

std::size_t Renderer::texture_bytes() const {
    std::size_t bytes = impl_->pool.bytes();
    for (const PassList::TextureInfo& texture : impl_->passes.textures())
        if (!texture.transient) bytes += gl::byte_size(texture.desc);
    return bytes;
}
std::size_t Renderer::volumetrics_bytes() const {
    return impl_->volumetrics->persistent_bytes();
}
Renderer::DrawCounts Renderer::draw_counts() const {
    const DrawList& draws = impl_->gbuffer.draws();
    return {draws.instance_count(), draws.triangle_count(), draws.draw_call_count()};
}

}  // namespace tyndall
