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
#include "engine/render/frame_module.h"
#include "engine/render/glass.h"
#include "engine/render/layers.h"
#include "engine/render/light_set.h"
#include "engine/render/passes/cluster.h"
#include "engine/render/passes/depth_pyramid.h"
#include "engine/render/passes/gbuffer.h"
#include "engine/render/passes/lighting.h"
#include "engine/render/passes/shadow_atlas.h"
#include "engine/render/passes/shadow_sun.h"
#include "engine/render/passes/sky.h"
#include "engine/render/passes/sky_volume.h"
#include "engine/render/passes/tonemap.h"
#include "engine/render/passes/transparent.h"
#include "shaders/shared/bindings.h"

namespace tyndall {

struct Renderer::Impl {
    Impl(ShaderLibrary& library, std::vector<FrameModule*> modules_)
        : shaders(library),
          modules(std::move(modules_)),
          shadow_sun(library),
          shadow_atlas(library),
          sky_volume(library) {}

    ShaderLibrary& shaders;
    std::vector<FrameModule*> modules;
    std::unique_ptr<GpuScene> scene;
    LightSet lights;
    ShadowSunPass shadow_sun;
    ShadowAtlasPass shadow_atlas;
    GBufferPass gbuffer;
    ClusterPass cluster;
    SkyPass sky;
    SkyVolumePass sky_volume;
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
    struct KeptLayer {
        gl::TextureView texture;
        Layer layer;
    };
    std::map<std::string, KeptLayer> layers;  ///< those that were asked for
    float light_unit = 1;                     ///< of the frame
    std::string layer;

    void resize(glm::ivec2 size);
    [[nodiscard]] shared::FrameData frame_data(const FrameContext& frame) const;
    LightSources add_lights(FrameContext& frame, const GBuffer& g, const ShadowSunPass::Output& sun);
    void add_passes(FrameContext& frame, LightSources& sources);
    [[nodiscard]] TextureRef add_display(FrameContext& frame, TextureRef radiance);
    void keep_layer(const Layer& layer);
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
    const float light_unit = frame.scene.light_unit();
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
        data.sun_direction = glm::vec4(-glm::vec3(node_pose(frame.scene, sun.node)[2]), 1);
        data.sun_illuminance = glm::vec4(sun.intensity / light_unit, 0);
    }
    data.exposure =
        glm::vec4(light_unit * exposure_factor(frame.scene.exposure_ev100, frame.settings.exposure_bias),
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
        const ShadowAtlasPass::Output shadows = shadow_atlas.add(frame);
        lights.set_shadow_tiles([this](std::size_t light) { return shadow_atlas.first_tile(light); });
        lights.upload();
        sample(shadows.atlas);
        sample(shadows.glass);
        sources.buffers = {clusters.ranges, clusters.lights};
        if (shadows.tiles) sources.buffers.push_back(shadows.tiles);
    } else {
        for (const char* name : {"depth_pyramid", "light_cull", "cluster", "shadow_atlas", "shadow_atlas/glass"})
            passes.skip(name, "no lamp in view");
    }
    const SkyPass::Output dome = sky.add(frame);
    sources.sky = dome.radiance;
    sample(sun.cascades);
    sample(sun.static_map);
    sample(sun.glass);
    if (facts.has_ambient) sample(dome.irradiance);
    sample(sky_volume.add(frame, dome.radiance, sky.key()));
    sources.bind = [this, lamps] {
        frame_block.bind(GL_UNIFORM_BUFFER, BINDING_FRAME);
        if (facts.has_sun) shadow_sun.bind();
        if (facts.has_ambient) sky.bind_ambient();
        if (facts.sky_visibility) sky_volume.bind();
        if (!lamps) return;
        lights.bind();
        cluster.bind();
        shadow_atlas.bind();
    };
    return sources;
}

void Renderer::Impl::add_passes(FrameContext& frame, LightSources& sources) {
    const ShadowSunPass::Output sun = shadow_sun.add(frame);
    const bool motion = std::ranges::any_of(modules, [&](FrameModule* m) { return m->wants_motion(frame); });
    const GBuffer g = gbuffer.add(frame, motion ? previous_view_projection : std::nullopt);
    sources = add_lights(frame, g, sun);
    transparent.gather(frame);
    for (FrameModule* module : modules) module->add_before_lighting(frame, g, transparent.bounds(), sources);

    TextureRef radiance = passes.import("color", color);
    radiance = add_lighting(frame, g, sources, radiance);
    radiance = sky.add_background(frame, {sources.sky, {}}, g.depth, radiance);
    for (FrameModule* module : modules) radiance = module->add_after_lighting(frame, radiance);
    radiance = transparent.add(frame, g, sources, modules, radiance);
    passes.export_texture(radiance);
    passes.export_texture(add_display(frame, radiance));

    if (layers.contains("color")) layers["color"] = {color, {.name = "color", .texture = {}, .is_light = true}};
    for (const Layer& own : surface_layers(g, frame.view.znear)) keep_layer(own);
    for (const FrameModule* module : modules)
        for (const Layer& added : module->layers()) keep_layer(added);
}

TextureRef Renderer::Impl::add_display(FrameContext& frame, TextureRef radiance) {
    const TextureRef screen = passes.import("display", display);
    for (FrameModule* module : modules)
        if (const TextureRef shown = module->add_display(frame, screen)) return shown;
    return add_tonemap(frame, radiance, screen);
}

/// If it was asked for: a pass that runs last remembers the texture, so that nothing later takes its memory.
void Renderer::Impl::keep_layer(const Layer& layer) {
    const auto asked = layers.find(layer.name);
    if (asked == layers.end()) return;
    asked->second.layer = layer;
    if (!layer.texture) return;
    passes.add(
        "export/" + layer.name,
        [&](PassBuilder& pass) {
            pass.sample(layer.texture);
            pass.keep();
        },
        [&kept = asked->second](const PassContext& pass) { kept.texture = pass.texture(kept.layer.texture); });
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

Renderer::Renderer(ShaderLibrary& shaders, std::vector<FrameModule*> modules)
    : impl_(std::make_unique<Impl>(shaders, std::move(modules))) {}
Renderer::~Renderer() = default;

void Renderer::prepare(const Scene& scene, float anisotropy) {
    impl_->scene = std::make_unique<GpuScene>(scene, anisotropy);
    impl_->previous_view_projection.reset();
}

void Renderer::render(const Scene& scene, const View& view, glm::ivec2 size, const FrameOptions& options) {
    Impl& r = *impl_;
    TYNDALL_CHECK(r.scene);
    if (r.light_unit != scene.light_unit()) invalidate_history();
    r.light_unit = scene.light_unit();
    r.layers.clear();
    std::vector<std::string> wanted = options.more_layers;
    wanted.push_back(options.layer);
    const std::vector<std::string> known = layer_names(r.modules);
    for (const std::string& name : wanted) {
        if (std::ranges::count(known, name) == 0)
            throw UsageError(fmt::format("layer '{}': expected one of {}", name, fmt::join(known, ", ")));
        r.layers[name] = {};
    }
    r.resize(size);
    r.scene->update(scene);
    r.layer = options.layer;
    r.facts = compute_facts(scene, view);
    r.facts.has_ambient = options.render.ambient > 0;
    // Isotropic media under an open sky have the same light everywhere.
    r.facts.sky_visibility =
        r.facts.has_ambient && options.render.sky_visibility &&
        (has_static_casters(*r.scene) ||
         std::ranges::any_of(scene.media, [](const Medium& medium) { return medium.anisotropy != 0; }));
    if (options.render.shadows) find_glass(scene, *r.scene, view, r.facts);
    r.lights.update(scene, r.facts.lamps);
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
                       .count_work = options.count_work,
                       .progressive = options.progressive,
                       .layers = wanted};
    data = r.frame_data(frame);
    LightSources sources;
    r.add_passes(frame, sources);
    r.execute(data, options);
    r.previous_view_projection = view.view_projection;
}

void Renderer::invalidate_history() {
    for (FrameModule* module : impl_->modules) module->forget_history();
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
    const auto& [texture, layer] = impl_->layers.at(name);
    if (texture) {
        Image image = layer.decode(gl::read_texture(texture), size());
        if (layer.is_light)
            for (float& value : image.pixels) value *= impl_->light_unit;
        return image;
    }
    Image image(size(), 3);
    std::ranges::fill(image.pixels, layer.absent);
    return image;
}
std::vector<std::string> Renderer::layer_names(std::span<FrameModule* const> modules) {
    std::vector<std::string> names{"color"};
    for (const Layer& layer : surface_layers({}, 0)) names.push_back(layer.name);
    for (const FrameModule* module : modules)
        for (const Layer& layer : module->layers()) names.push_back(layer.name);
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
Renderer::DrawCounts Renderer::draw_counts() const {
    const DrawList& draws = impl_->gbuffer.draws();
    return {draws.instance_count(), draws.triangle_count(), draws.draw_call_count()};
}

}  // namespace tyndall
