#include "engine/render/passes/shadow_atlas.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "engine/core/check.h"
#include "engine/core/log.h"
#include "engine/render/shadow_tiles.h"
#include "shaders/shared/bindings.h"

namespace tyndall {
namespace {

int power_of_two(int size) {
    return static_cast<int>(std::bit_floor(static_cast<unsigned>(std::max(size, smallest_shadow_tile))));
}

bool casts(const Light& light) {
    return light.shadow && light.node >= 0;
}

/// The brightest sun has maps of its own.
bool any_casts(const Scene& scene) {
    std::vector<std::size_t> suns = scene.suns();
    if (!suns.empty()) suns.erase(suns.begin());
    return std::ranges::any_of(suns, [&](std::size_t i) { return casts(scene.lights[i]); }) ||
           std::ranges::any_of(scene.lights, [](const Light& l) { return l.type != LightType::sun && casts(l); });
}

}  // namespace

ShadowAtlasPass::ShadowAtlasPass(ShaderLibrary& shaders)
    : depth_(shaders),
      texels_({.min_filter = GL_NEAREST, .mag_filter = GL_NEAREST}, "shadow atlas texels"),
      glass_filter_(shaders) {}

void ShadowAtlasPass::release(FrameContext& context, const char* reason) {
    atlas_ = {};
    still_ = {};
    glass_ = {};
    tile_buffer_ = {};
    draws_ = {};
    lights_.clear();
    tile_data_.clear();
    context.passes.skip("shadow_atlas", reason);
    context.passes.skip("shadow_atlas/glass", reason);
}

// Fills level and wanted of the lights in view.
void ShadowAtlasPass::plan(const FrameContext& context, std::span<const std::size_t> casters) {
    const Scene& scene = context.scene;
    const int size_max = std::min(power_of_two(context.settings.tile_size_max), allocator_.size());
    std::vector<TileDemand> demands;
    for (const std::size_t i : casters) {
        const Light& light = scene.lights[i];
        const float distance = glm::distance(context.view.eye, glm::vec3(node_pose(scene, light.node)[3]));
        lights_[i].level = light.type == LightType::sun
                               ? std::countr_zero(static_cast<unsigned>(size_max))
                               : shadow_tile_level(light.range, distance, size_max, lights_[i].level);
        demands.push_back({lights_[i].level, shadow_tile_count(light.type)});
    }
    const long long area = static_cast<long long>(allocator_.size()) * allocator_.size();
    const std::vector<int> sizes = plan_tile_sizes(demands, size_max, area);
    for (std::size_t i = 0; i < casters.size(); ++i) lights_[casters[i]].wanted = sizes[i];
    if (std::ranges::count(sizes, 0) > 0 && !warned_) {
        warned_ = true;
        spdlog::warn("shadow atlas: {} of {} lights in view have no room for a shadow; a larger atlas_size has",
                     std::ranges::count(sizes, 0), sizes.size());
    }
}

void ShadowAtlasPass::drop(LightTiles& light) {
    for (const Tile& tile : light.tiles) allocator_.free(tile.place);
    light.tiles.clear();
}

// All tiles of a light or none; on success its old ones are given back.
bool ShadowAtlasPass::place(LightTiles& light, int count, int size) {
    std::vector<Tile> tiles;
    for (int i = 0; i < count; ++i) {
        const auto place = allocator_.allocate(size);
        if (!place) {
            for (const Tile& tile : tiles) allocator_.free(tile.place);
            return false;
        }
        tiles.push_back({*place});
    }
    drop(light);
    light.tiles = std::move(tiles);
    return true;
}

bool ShadowAtlasPass::drop_one_out_of_view() {
    const auto unseen = [&](const LightTiles& light) { return light.seen != frame_ && !light.tiles.empty(); };
    LightTiles* oldest = nullptr;
    for (LightTiles& light : lights_)
        if (unseen(light) && (oldest == nullptr || light.seen < oldest->seen)) oldest = &light;
    if (oldest == nullptr) return false;
    drop(*oldest);
    return true;
}

// Everything anew, largest first, which always fits what was planned.
void ShadowAtlasPass::repack(const Scene& scene, std::span<const std::size_t> casters) {
    allocator_.clear();
    for (LightTiles& light : lights_) light.tiles.clear();
    std::vector<std::size_t> order(casters.begin(), casters.end());
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return lights_[i].wanted; });
    for (const std::size_t i : order) {
        if (lights_[i].wanted == 0) continue;
        const bool placed = place(lights_[i], shadow_tile_count(scene.lights[i].type), lights_[i].wanted);
        TYNDALL_CHECK(placed);
    }
}

// Changes as little as it can: a light whose tiles have the wanted size keeps them; one that cannot grow for want
// of a large enough gap keeps what it has; a new one takes a smaller gap rather than move others.
void ShadowAtlasPass::assign(const Scene& scene, std::span<const std::size_t> casters) {
    std::vector<std::size_t> unplaced, growing;
    for (const std::size_t i : casters) {
        LightTiles& light = lights_[i];
        const int count = shadow_tile_count(scene.lights[i].type);
        if (static_cast<int>(light.tiles.size()) != count || light.size() > light.wanted) drop(light);
        if (light.wanted == 0 || light.size() == light.wanted) continue;
        (light.tiles.empty() ? unplaced : growing).push_back(i);
    }
    const auto larger = [&](std::size_t a, std::size_t b) { return lights_[a].wanted > lights_[b].wanted; };
    std::ranges::stable_sort(unplaced, larger);
    std::ranges::stable_sort(growing, larger);
    const auto fits = [&](std::size_t i, int size) {
        while (!place(lights_[i], shadow_tile_count(scene.lights[i].type), size))
            if (!drop_one_out_of_view()) return false;
        return true;
    };
    for (const std::size_t i : unplaced) {
        int size = lights_[i].wanted;
        while (size >= smallest_shadow_tile && !fits(i, size)) size /= 2;
        if (size < smallest_shadow_tile) return repack(scene, casters);
    }
    long long missing = 0;
    for (const std::size_t i : growing) {
        const long long count = shadow_tile_count(scene.lights[i].type);
        if (!fits(i, lights_[i].wanted)) missing += count * lights_[i].wanted * lights_[i].wanted;
    }
    const long long area = static_cast<long long>(allocator_.size()) * allocator_.size();
    if (missing > area / 8) repack(scene, casters);
}

// The tile buffer holds the tiles of all lights, in the order of the scene's lights.
void ShadowAtlasPass::number_tiles(const FrameContext& context) {
    const Scene& scene = context.scene;
    std::vector<shared::ShadowTile> data;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        LightTiles& light = lights_[i];
        light.first = light.tiles.empty() ? -1 : static_cast<int>(data.size());
        const glm::mat4 world = node_pose(scene, scene.lights[i].node);
        for (std::size_t face = 0; face < light.tiles.size(); ++face) {
            const AtlasTile& place = light.tiles[face].place;
            data.push_back(
                scene.lights[i].type == LightType::sun
                    ? make_sun_tile(static_bounds(context.gpu.instances(), scene.bounds), world, place,
                                    allocator_.size())
                    : make_shadow_tile(scene.lights[i], world, static_cast<int>(face), place, allocator_.size()));
        }
    }
    if (data.empty()) data.emplace_back();  // a buffer of no bytes cannot be bound
    const std::size_t bytes = data.size() * sizeof(shared::ShadowTile);
    if (tile_buffer_ && data.size() == tile_data_.size() && std::memcmp(data.data(), tile_data_.data(), bytes) == 0)
        return;
    tile_data_ = std::move(data);
    tile_buffer_.assign(std::span<const shared::ShadowTile>(tile_data_), "shadow tiles");
}

void ShadowAtlasPass::find_redraws(const FrameContext& context, std::span<const std::size_t> casters) {
    const ShadowCasters occluders(context.scene, context.gpu);
    redraws_.clear();
    for (const std::size_t i : casters) {
        LightTiles& light = lights_[i];
        if (light.tiles.empty()) continue;
        const glm::vec3 position(node_pose(context.scene, context.scene.lights[i].node)[3]);
        const bool near_moving = context.scene.lights[i].type == LightType::sun ||
                                 occluders.moving_within(position, context.scene.lights[i].range);
        for (std::size_t face = 0; face < light.tiles.size(); ++face) {
            const shared::ShadowTile& data = tile_data_[light.first + face];
            ShadowKey key;
            key.add(data.world_to_clip);
            key.add(data.rect);
            key.add(occluders.static_key());
            const std::uint64_t still_key = key.value();
            const std::uint64_t moving_key =
                near_moving ? occluders.moving_key(Frustum::from(data.world_to_clip)) : 0;
            if (moving_key != 0) key.add(moving_key);
            light.tiles[face].key = key.value();
            if (key.value() != light.tiles[face].drawn_key)
                redraws_.push_back({i, face, key.value(), data, still_key, moving_key != 0});
        }
    }
}

void ShadowAtlasPass::draw_casters(const GpuScene& gpu, std::span<const Redraw> tiles, DrawList::Filter casters) {
    std::vector<Frustum> frusta;
    for (const Redraw& redraw : tiles) frusta.push_back(Frustum::from(redraw.data.world_to_clip));
    draws_.build(gpu, frusta, casters);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const AtlasTile& place = lights_[tiles[i].light].tiles[tiles[i].tile].place;
        gl::apply(ShadowDepth::state());
        glEnable(GL_SCISSOR_TEST);  // clears reach their own tile only
        glViewport(place.origin.x, place.origin.y, place.size, place.size);
        glScissor(place.origin.x, place.origin.y, place.size, place.size);
        if (casters == DrawList::Filter::static_shadow_casters) glClear(GL_DEPTH_BUFFER_BIT);
        const int view = static_cast<int>(i);
        depth_.draw(gpu, draws_, view, tiles[i].data.world_to_clip, false);
        triangles_drawn_ += draws_.triangle_count(view);
    }
}

void ShadowAtlasPass::copy(std::span<const Redraw> tiles, const gl::Texture& from, const gl::Texture& to) const {
    for (const Redraw& redraw : tiles) {
        const auto& [origin, size] = lights_[redraw.light].tiles[redraw.tile].place;
        glCopyImageSubData(from.id(), GL_TEXTURE_2D, 0, origin.x, origin.y, 0, to.id(), GL_TEXTURE_2D, 0, origin.x,
                           origin.y, 0, size, size, 1);
    }
}

// Copies stand together: between draws each would end a software rasteriser's work on the whole atlas.
void ShadowAtlasPass::draw(const PassContext& pass, const GpuScene& gpu) {
    const auto tile = [&](const Redraw& r) -> Tile& { return lights_[r.light].tiles[r.tile]; };
    const auto rank = [&](const Redraw& r) {
        const bool kept = tile(r).kept_key == r.still_key;
        return kept ? (r.moving ? 1 : 0) : (r.moving ? 2 : 3);
    };
    std::ranges::stable_sort(redraws_, {}, rank);
    const auto ranks = [&](int first, int last) {
        return std::span(std::ranges::lower_bound(redraws_, first, {}, rank),
                         std::ranges::upper_bound(redraws_, last, {}, rank));
    };
    const std::span<const Redraw> kept = ranks(0, 1), moving = ranks(1, 2), keep = ranks(2, 2), anew = ranks(2, 3);

    pass.bind_framebuffer();
    glClearDepthf(0);
    copy(kept, still_, atlas_);
    draw_casters(gpu, anew, DrawList::Filter::static_shadow_casters);
    copy(keep, atlas_, still_);
    draw_casters(gpu, moving, DrawList::Filter::moving_shadow_casters);
    for (const Redraw& redraw : keep) tile(redraw).kept_key = redraw.still_key;
    for (const Redraw& redraw : redraws_) tile(redraw).drawn_key = redraw.key;
    tiles_drawn_ = static_cast<int>(redraws_.size());
}

void ShadowAtlasPass::find_glass_redraws(const FrameContext& context) {
    const ShadowCasters glass(context.scene, context.gpu, true);
    glass_redraws_.clear();
    for (const Lamp& lamp : context.facts.lamps) {
        if (!lamp.through_glass) continue;
        LightTiles& light = lights_[lamp.light];
        for (std::size_t face = 0; face < light.tiles.size(); ++face) {
            const shared::ShadowTile& data = tile_data_[light.first + face];
            ShadowKey key;
            key.add(light.tiles[face].key);
            key.add(std::uint64_t{glass_.id()});
            key.add(glass.static_key());
            key.add(glass.moving_key(Frustum::from(data.world_to_clip)));
            if (key.value() != light.tiles[face].glass_key)
                glass_redraws_.push_back({lamp.light, face, key.value(), data});
        }
    }
}

void ShadowAtlasPass::draw_glass(const PassContext& pass, const FrameContext& context, gl::TextureView shadows) {
    std::vector<Frustum> frusta;
    for (const Redraw& redraw : glass_redraws_) frusta.push_back(Frustum::from(redraw.data.world_to_clip));
    glass_draws_.build(context.gpu, frusta, DrawList::Filter::glass);
    pass.bind_framebuffer();
    for (std::size_t i = 0; i < glass_redraws_.size(); ++i) {
        const Redraw& redraw = glass_redraws_[i];
        Tile& tile = lights_[redraw.light].tiles[redraw.tile];
        const glm::ivec2 origin = tile.place.origin / 2;
        const int size = tile.place.size / 2;
        glEnable(GL_SCISSOR_TEST);
        glViewport(origin.x, origin.y, size, size);
        glScissor(origin.x, origin.y, size, size);
        ShadowGlass::clear();
        const bool is_sun = context.scene.lights[redraw.light].type == LightType::sun;
        glass_filter_.draw(context.gpu, glass_draws_, static_cast<int>(i),
                           {.world_to_clip = redraw.data.world_to_clip,
                            .nearness = tile_nearness(redraw.data, is_sun),
                            .shadows = shadows,
                            .size = glass_.size().x});
        tile.glass_key = redraw.key;
    }
}

void ShadowAtlasPass::add_glass(FrameContext& context, Output& out) {
    const char* name = "shadow_atlas/glass";
    if (std::ranges::none_of(context.facts.lamps, &Lamp::through_glass)) {
        glass_ = {};
        context.passes.skip(name, "no glass before a lamp in view");
        return;
    }
    const gl::TextureDesc desc = ShadowGlass::desc(atlas_.size().x / 2, 1);
    if (!glass_ || glass_.desc() != desc) glass_ = gl::Texture(desc, "lamp glass");
    out.glass = context.passes.import("lamp glass", glass_);
    find_glass_redraws(context);
    if (glass_redraws_.empty()) {
        context.passes.skip(name, "unchanged since it was drawn");
        return;
    }
    context.passes.add(
        name,
        [&](PassBuilder& pass) {
            pass.sample(out.atlas);
            out.glass = pass.attach_color(out.glass, 0, 0);
        },
        [this, &context, atlas = out.atlas](const PassContext& pass) {
            draw_glass(pass, context, pass.texture(atlas));
        });
}

ShadowAtlasPass::Output ShadowAtlasPass::add(FrameContext& context) {
    tiles_drawn_ = 0;
    triangles_drawn_ = 0;
    ++frame_;
    const Scene& scene = context.scene;
    if (!context.settings.shadows || !any_casts(scene)) {
        release(context, context.settings.shadows ? "no lamp of the scene casts shadows" : "shadows are off");
        return {};
    }
    const int size = power_of_two(context.settings.atlas_size);
    if (!atlas_ || atlas_.size().x != size || lights_.size() != scene.lights.size()) {
        atlas_ = gl::Texture({.format = GL_DEPTH_COMPONENT32F, .size = {size, size, 1}}, "shadow atlas");
        allocator_ = AtlasAllocator(size, smallest_shadow_tile);
        still_ = {};
        lights_.assign(scene.lights.size(), {});
    }

    std::vector<std::size_t> casters;
    for (const Lamp& lamp : context.facts.lamps)
        if (lamp.in_view && casts(scene.lights[lamp.light])) casters.push_back(lamp.light);
    for (std::size_t i = 0; i < lights_.size(); ++i)
        if (!casts(scene.lights[i])) drop(lights_[i]);
    for (const std::size_t i : casters) lights_[i].seen = frame_;
    plan(context, casters);
    assign(scene, casters);
    number_tiles(context);
    find_redraws(context, casters);
    if (!still_ && std::ranges::any_of(redraws_, &Redraw::moving))
        still_ = gl::Texture(atlas_.desc(), "shadow atlas without what moves");

    Output out{context.passes.import("shadow atlas", atlas_),
               context.passes.import_buffer("shadow tiles", tile_buffer_.id()),
               {}};
    if (redraws_.empty())
        context.passes.skip("shadow_atlas",
                            casters.empty() ? "no shadow-casting lamp in view" : "unchanged since it was drawn");
    else
        context.passes.add(
            "shadow_atlas", [&](PassBuilder& pass) { out.atlas = pass.attach_depth(out.atlas); },
            [this, &gpu = context.gpu](const PassContext& pass) { draw(pass, gpu); });
    add_glass(context, out);
    return out;
}

int ShadowAtlasPass::first_tile(std::size_t scene_light_index) const {
    return scene_light_index < lights_.size() ? lights_[scene_light_index].first : -1;
}

void ShadowAtlasPass::bind() const {
    glBindTextureUnit(UNIT_SHADOW_ATLAS, atlas_.id());
    glBindSampler(UNIT_SHADOW_ATLAS, texels_.id());
    if (tile_buffer_) tile_buffer_.bind(IMAGE_SHADOW_TILES);
    if (!glass_) return;
    glBindTextureUnit(UNIT_LAMP_GLASS, glass_.id());
    glBindSampler(UNIT_LAMP_GLASS, texels_.id());
}

}  // namespace tyndall
