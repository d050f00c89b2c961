#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/sampler.h"
#include "engine/gl/texel_buffer.h"
#include "engine/gl/texture.h"
#include "engine/graph/pass_list.h"
#include "engine/render/atlas_allocator.h"
#include "engine/render/draw_list.h"
#include "engine/render/frame_context.h"
#include "engine/render/passes/shadow_casters.h"
#include "engine/render/passes/shadow_glass.h"
#include "shaders/shared/lights.h"

namespace tyndall {

/// Shadow maps of lamps and further suns: tiles of one texture, sized by importance on screen. A tile is drawn
/// again only when its place, its light or a caster in its view changed. Where something moves before a light, what
/// stands still is kept, and only what moves is drawn over a copy of it.
class ShadowAtlasPass {
  public:
    explicit ShadowAtlasPass(ShaderLibrary& shaders);

    struct Output {
        TextureRef atlas;  ///< D32F; empty when no lamp of the scene casts shadows or shadows are off
        BufferRef tiles;   ///< shared::ShadowTile[]
        TextureRef glass;  ///< RGBA16 array of one layer, half as wide; empty without glass before a lamp in view
    };
    /// Gives the shadow casters among the lamps in view tiles and adds the pass "shadow_atlas" if any must be drawn
    /// (else skips it with the reason), and "shadow_atlas/glass" for the tiles of lamps that glass stands before.
    /// Lights out of view keep tiles while there is room. Without a shadow-casting lamp, or with settings.shadows
    /// off, everything is freed.
    Output add(FrameContext& context);
    /// Index of a scene light's first tile in the tile buffer, -1 when it has none. Valid after add().
    [[nodiscard]] int first_tile(std::size_t scene_light_index) const;
    /// Tiles that this frame's pass list has drawn.
    [[nodiscard]] int tiles_drawn() const { return tiles_drawn_; }
    /// Triangles drawn into them, glass left out.
    [[nodiscard]] std::size_t triangles_drawn() const { return triangles_drawn_; }
    /// Binds textures, samplers and tile buffer (UNIT_SHADOW_ATLAS, UNIT_LAMP_GLASS, IMAGE_SHADOW_TILES) for
    /// shadow_lookup.glsl and glass_lookup.glsl.
    void bind() const;

  private:
    struct Tile {
        AtlasTile place;
        std::uint64_t key = 0;  ///< of this frame
        std::uint64_t drawn_key = 0, kept_key = 0, glass_key = 0;
    };
    struct LightTiles {
        int level = -1;  ///< from shadow_tile_level, of the last time in view
        int wanted = 0;  ///< px, 0 when out of view
        int first = -1;
        std::uint64_t seen = 0;  ///< frame count of the last time in view
        std::vector<Tile> tiles;
        [[nodiscard]] int size() const { return tiles.empty() ? 0 : tiles[0].place.size; }
    };
    struct Redraw {
        std::size_t light, tile;
        std::uint64_t key;
        shared::ShadowTile data;
        std::uint64_t still_key = 0;  ///< of what stands still
        bool moving = false;          ///< something before the light moves
    };

    void release(FrameContext& context, const char* reason);
    void plan(const FrameContext& context, std::span<const std::size_t> casters);
    void assign(const Scene& scene, std::span<const std::size_t> casters);
    [[nodiscard]] bool place(LightTiles& light, int count, int size);
    void drop(LightTiles& light);
    [[nodiscard]] bool drop_one_out_of_view();
    void repack(const Scene& scene, std::span<const std::size_t> casters);
    void number_tiles(const FrameContext& context);
    void find_redraws(const FrameContext& context, std::span<const std::size_t> casters);
    void draw(const PassContext& pass, const GpuScene& gpu);
    void draw_casters(const GpuScene& gpu, std::span<const Redraw> tiles, DrawList::Filter casters);
    void copy(std::span<const Redraw> tiles, const gl::Texture& from, const gl::Texture& to) const;
    void add_glass(FrameContext& context, Output& out);
    void find_glass_redraws(const FrameContext& context);
    void draw_glass(const PassContext& pass, const FrameContext& context, gl::TextureView shadows);

    ShadowDepth depth_;
    gl::Sampler texels_;
    gl::Texture atlas_, glass_;
    gl::Texture still_;  ///< the atlas without what moves; empty where nothing moves before a light
    ShadowGlass glass_filter_;
    gl::TexelBuffer tile_buffer_;
    AtlasAllocator allocator_;
    std::vector<LightTiles> lights_;  // one per scene light
    std::vector<shared::ShadowTile> tile_data_;
    std::vector<Redraw> redraws_, glass_redraws_;
    DrawList draws_, glass_draws_;
    std::uint64_t frame_ = 0;
    int tiles_drawn_ = 0;
    std::size_t triangles_drawn_ = 0;
    bool warned_ = false;
};

}  // namespace tyndall
