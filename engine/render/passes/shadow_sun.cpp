#include "engine/render/passes/shadow_sun.h"

#include <fmt/format.h>

#include <algorithm>

#include "shaders/shared/bindings.h"
#include "shaders/shared/shadows.h"

namespace tyndall {
namespace {

std::string pass_name(int index) {
    return index < SUN_CASCADES ? fmt::format("shadow_sun/cascade_{}", index) : "shadow_sun/static";
}

std::string glass_pass_name(int index) {
    return fmt::format("shadow_sun/glass_{}", index);
}

gl::TextureDesc map_desc(gl::TextureKind kind, int size, int layers) {
    return {.kind = kind, .format = GL_DEPTH_COMPONENT32F, .size = {size, size, layers}};
}

void ensure(gl::Texture& texture, const gl::TextureDesc& desc, const char* label) {
    if (!texture || texture.desc() != desc) texture = gl::Texture(desc, label);
}

}  // namespace

ShadowSunPass::ShadowSunPass(ShaderLibrary& shaders)
    : depth_(shaders),
      texels_({.min_filter = GL_NEAREST, .mag_filter = GL_NEAREST}, "sun shadow texels"),
      draw_glass_(shaders) {}

void ShadowSunPass::release(FrameContext& context, const std::string& reason) {
    cascades_ = {};
    still_ = {};
    static_ = {};
    glass_ = {};
    for (int i = 0; i <= SUN_CASCADES; ++i) {
        maps_[i] = {};
        context.passes.skip(pass_name(i), reason);
        context.passes.skip(glass_pass_name(i), reason);
    }
    // Every point lies behind the cascades and outside the static map: lit, without a fetch.
    context.frame.sun_cascade_far = glm::vec4(0);
    context.frame.sun_static = glm::mat4(0);
    context.frame.sun_static[3] = glm::vec4(-1, -1, 0, 1);
}

void ShadowSunPass::resize(const RenderSettings& settings) {
    const int size = cascade_map_size(settings.cascade_size);
    ensure(cascades_, map_desc(gl::TextureKind::d2_array, size, SUN_CASCADES), "sun cascades");
    if (still_ && still_.desc() != cascades_.desc()) {
        still_ = {};
        for (Map& map : maps_) map.kept_key = 0;
    }
    ensure(static_, map_desc(gl::TextureKind::d2, settings.static_shadow_size, 1), "sun static shadow");
}

void ShadowSunPass::fit(FrameContext& context, glm::vec3 direction) {
    const RenderSettings& settings = context.settings;
    const View& view = context.view;
    const float far = std::max(settings.cascade_distance, 2 * view.znear);
    const auto ends = cascade_ends(view.znear, far, settings.cascade_split);
    shared::FrameData& frame = context.frame;
    for (int i = 0; i < SUN_CASCADES; ++i) {
        const float begin = i == 0 ? view.znear : ends[i - 1] * (1 - SUN_CASCADE_BLEND);
        maps_[i].fit = fit_cascade(view, begin, ends[i], direction, settings.cascade_size);
        frame.sun_cascade[i] = maps_[i].fit.world_to_texture;
        frame.sun_cascade_far[i] = ends[i];
        frame.sun_texel[i] = maps_[i].fit.texel;
    }
    const SunMap all = fit_static(static_bounds(context.gpu.instances(), context.scene.bounds), direction,
                                  settings.static_shadow_size);
    maps_[static_map].fit = all;
    frame.sun_static = all.world_to_texture;
    frame.sun_static_texel = glm::vec4(all.texel, 1.0f / static_cast<float>(cascades_.size().x),
                                       1.0f / static_cast<float>(settings.static_shadow_size), 0);
}

void ShadowSunPass::draw_casters(const GpuScene& gpu, Map& map, DrawList::Filter casters) {
    map.draws.build(gpu, caster_volume(map.fit), casters);
    depth_.draw(gpu, map.draws, 0, world_to_clip(map.fit), true);
    triangles_drawn_ += map.draws.triangle_count();
}

// What does not move, into the bound layer: drawn, or copied from where it is kept.
void ShadowSunPass::draw_still(const GpuScene& gpu, int index, std::uint64_t key, bool keep) {
    Map& map = maps_[index];
    const int size = cascades_.size().x;
    const auto copy = [&](const gl::Texture& from, const gl::Texture& to) {
        glCopyImageSubData(from.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, index, to.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0,
                           index, size, size, 1);
    };
    if (map.kept_key == key) return copy(still_, cascades_);
    gl::apply(ShadowDepth::state());
    glClearDepthf(0);
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_casters(gpu, map, DrawList::Filter::static_shadow_casters);
    if (!keep) return;
    copy(cascades_, still_);
    map.kept_key = key;
}

TextureRef ShadowSunPass::add_map(FrameContext& context, const ShadowCasters& casters, int index,
                                  TextureRef texture) {
    Map& map = maps_[index];
    const bool is_static = index == static_map;
    const Frustum volume = caster_volume(map.fit);
    ShadowKey key;
    key.add(map.fit.world_to_texture);
    key.add(std::uint64_t{(is_static ? static_ : cascades_).id()});
    key.add(casters.static_key());
    const std::uint64_t still_key = key.value(), moving_key = is_static ? 0 : casters.moving_key(volume);
    if (moving_key != 0) key.add(moving_key);
    map.key = key.value();
    const bool moving = moving_key != 0;
    if (moving && !still_) still_ = gl::Texture(cascades_.desc(), "sun cascades without what moves");
    if (map.key == map.drawn_key) {
        context.passes.skip(pass_name(index), "unchanged since it was drawn");
        return texture;
    }
    context.passes.add(
        pass_name(index),
        [&](PassBuilder& pass) { texture = pass.attach_depth(texture, 0, is_static ? -1 : index); },
        [this, &map, index, still_key, moving, &gpu = context.gpu](const PassContext& pass) {
            pass.bind_framebuffer();
            draw_still(gpu, index, still_key, moving);
            if (moving) draw_casters(gpu, map, DrawList::Filter::moving_shadow_casters);
            map.drawn_key = map.key;
        });
    return texture;
}

TextureRef ShadowSunPass::add_glass_map(FrameContext& context, const ShadowCasters& casters, int index,
                                        TextureRef shadows, TextureRef glass) {
    Map& map = maps_[index];
    const bool is_static = index == static_map;
    const Frustum volume = caster_volume(map.fit);
    ShadowKey key;
    key.add(map.key);
    key.add(std::uint64_t{glass_.id()});
    key.add(casters.static_key());
    if (!is_static) key.add(casters.moving_key(volume));
    if (key.value() == map.glass_key) {
        context.passes.skip(glass_pass_name(index), "unchanged since it was drawn");
        return glass;
    }
    context.passes.add(
        glass_pass_name(index),
        [&](PassBuilder& pass) {
            pass.sample(shadows);
            glass = pass.attach_color(glass, 0, index);
        },
        [this, &map, volume, index, key, shadows, &gpu = context.gpu](const PassContext& pass) {
            pass.bind_framebuffer();
            ShadowGlass::clear();
            map.glass.build(gpu, volume,
                            index == static_map ? DrawList::Filter::static_glass : DrawList::Filter::glass);
            draw_glass_.draw(gpu, map.glass, 0,
                             {.world_to_clip = world_to_clip(map.fit),
                              .nearness = glm::transpose(map.fit.world_to_texture)[2],
                              .shadows = pass.texture(shadows),
                              .layer = index,
                              .size = glass_.size().x,
                              .depth_clamp = true});
            map.glass_key = key.value();
        });
    return glass;
}

void ShadowSunPass::add_glass(FrameContext& context, Output& out) {
    if (!context.facts.sun_through_glass) {
        glass_ = {};
        for (int i = 0; i <= SUN_CASCADES; ++i)
            context.passes.skip(glass_pass_name(i), "no glass between the sun and what is in view");
        return;
    }
    ensure(glass_, ShadowGlass::desc(cascades_.size().x, SUN_CASCADES + 1), "sun glass");
    context.frame.sun_static_texel.w = static_cast<float>(glass_.size().x);
    const ShadowCasters casters(context.scene, context.gpu, true);
    out.glass = context.passes.import("sun glass", glass_);
    for (int i = 0; i <= SUN_CASCADES; ++i)
        out.glass = add_glass_map(context, casters, i, i == static_map ? out.static_map : out.cascades, out.glass);
}

ShadowSunPass::Output ShadowSunPass::add(FrameContext& context) {
    triangles_drawn_ = 0;
    const auto sun = context.scene.sun();
    const bool casts = sun && context.scene.lights[*sun].shadow && context.scene.lights[*sun].node >= 0;
    if (!context.facts.has_sun || !sun || !casts || !context.settings.shadows) {
        release(context, !context.settings.shadows        ? "shadows are off"
                         : !context.facts.has_sun || !sun ? "no sun in the scene"
                                                          : "the sun casts no shadow");
        return {};
    }
    resize(context.settings);
    const Light& light = context.scene.lights[*sun];
    fit(context, -glm::vec3(node_pose(context.scene, light.node)[2]));

    const ShadowCasters casters(context.scene, context.gpu);
    Output out{context.passes.import("sun cascades", cascades_), context.passes.import("sun static", static_), {}};
    for (int i = 0; i < SUN_CASCADES; ++i) out.cascades = add_map(context, casters, i, out.cascades);
    out.static_map = add_map(context, casters, static_map, out.static_map);
    add_glass(context, out);
    return out;
}

void ShadowSunPass::bind() const {
    glBindTextureUnit(UNIT_SUN_CASCADES, cascades_.id());
    glBindTextureUnit(UNIT_SUN_STATIC, static_.id());
    glBindSampler(UNIT_SUN_CASCADES, texels_.id());
    glBindSampler(UNIT_SUN_STATIC, texels_.id());
    if (!glass_) return;
    glBindTextureUnit(UNIT_SUN_GLASS, glass_.id());
    glBindSampler(UNIT_SUN_GLASS, texels_.id());
}

}  // namespace tyndall
