#pragma once

#include <array>
#include <cstdint>

#include "engine/gl/sampler.h"
#include "engine/gl/texture.h"
#include "engine/graph/pass_list.h"
#include "engine/render/draw_list.h"
#include "engine/render/frame_context.h"
#include "engine/render/passes/shadow_casters.h"
#include "engine/render/passes/shadow_glass.h"
#include "engine/render/sun_cascades.h"

namespace tyndall {

/// Shadow maps of the sun: stable cascades near the eye, and behind them one map of the whole scene without what
/// moves. A map is drawn again only when its matrix or a caster in it changed, and of a cascade in which something
/// moves what stands still is kept: as long as the matrix stays, only what moves is drawn over a copy of it.
class ShadowSunPass {
  public:
    explicit ShadowSunPass(ShaderLibrary& shaders);

    struct Output {
        TextureRef cascades;    ///< D32F array, SUN_CASCADES layers; empty when there is no sun or shadows are off
        TextureRef static_map;  ///< D32F; likewise
        TextureRef glass;  ///< RGBA16 array, a layer for each of those maps; empty without glass before the sun
    };
    /// Adds "shadow_sun/cascade_0" … "_3" and "shadow_sun/static", and for glass "shadow_sun/glass_0" … "_4" (or
    /// skips them with the reason) and fills frame.sun_cascade, sun_static, sun_cascade_far, sun_texel and
    /// sun_static_texel. Without a sun, or with settings.shadows off, the textures are freed and lookups return 1.
    Output add(FrameContext& context);
    /// Binds textures and samplers at UNIT_SUN_CASCADES, UNIT_SUN_STATIC and UNIT_SUN_GLASS, for shadow_lookup.glsl
    /// and glass_lookup.glsl.
    void bind() const;
    /// Triangles that this frame's pass list has drawn into maps, glass left out.
    [[nodiscard]] std::size_t triangles_drawn() const { return triangles_drawn_; }

  private:
    static constexpr int static_map = SUN_CASCADES;  // index in maps_
    struct Map {
        SunMap fit;
        std::uint64_t key = 0;  ///< of this frame
        std::uint64_t drawn_key = 0, kept_key = 0, glass_key = 0;
        DrawList draws, glass;
    };
    void release(FrameContext& context, const std::string& reason);
    void resize(const RenderSettings& settings);
    void draw_casters(const GpuScene& gpu, Map& map, DrawList::Filter casters);
    void draw_still(const GpuScene& gpu, int index, std::uint64_t key, bool keep);
    void fit(FrameContext& context, glm::vec3 direction);
    TextureRef add_map(FrameContext& context, const ShadowCasters& casters, int index, TextureRef texture);
    void add_glass(FrameContext& context, Output& out);
    TextureRef add_glass_map(FrameContext& context, const ShadowCasters& casters, int index, TextureRef shadows,
                             TextureRef glass);

    ShadowDepth depth_;
    gl::Sampler texels_;
    gl::Texture cascades_, static_, glass_;
    gl::Texture still_;  ///< of the cascades, without what moves; empty where nothing moves in one
    std::size_t triangles_drawn_ = 0;
    ShadowGlass draw_glass_;
    std::array<Map, SUN_CASCADES + 1> maps_;
};

}  // namespace tyndall
