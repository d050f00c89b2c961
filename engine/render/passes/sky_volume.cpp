#include "engine/render/passes/sky_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "engine/core/check.h"
#include "engine/render/sun_cascades.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/sky_volume.h"

namespace tyndall {
namespace {

const ProgramDesc links_program{
    "sky_volume/links",
    {{GL_VERTEX_SHADER, "shaders/engine/sky_links.vert"}, {GL_FRAGMENT_SHADER, "shaders/engine/sky_links.frag"}},
    {},
    {}};
const ProgramDesc gather_program{
    "sky_volume/gather", {{GL_COMPUTE_SHADER, "shaders/engine/sky_gather.comp"}}, {}, {}};
const ProgramDesc solid_program{"sky_volume/solid", {{GL_COMPUTE_SHADER, "shaders/engine/sky_solid.comp"}}, {}, {}};
const ProgramDesc spread_program{
    "sky_volume/spread", {{GL_COMPUTE_SHADER, "shaders/engine/sky_spread.comp"}}, {}, {}};
const ProgramRegistry::Registration registrations[] = {
    ProgramRegistry::Registration(links_program), ProgramRegistry::Registration(gather_program),
    ProgramRegistry::Registration(solid_program), ProgramRegistry::Registration(spread_program)};

constexpr int map_count = 16;          // depth maps that are read at once
constexpr int texels_per_cell = 4;     // of a map, where it sees the level along an axis
constexpr int directions_a_frame = 4;  // while a level is built progressively
constexpr float growth = 3;            // of cells from level to level
constexpr int sky_mip = 1;             // 64 texels a side are plenty for parts of the sky
// Of a cell, by which centres lie beside the round numbers at which levels have their walls.
const glm::vec3 off_lattice(0.37f, 0.41f, 0.43f);
constexpr float dark_share = 1e-5f;  // of the open sky: as good as none

std::string pass_name(int level) {
    return fmt::format("sky_volume/level_{}", level);
}

gl::TextureDesc volume_desc(GLenum format, glm::ivec3 size) {
    return {.kind = gl::TextureKind::d3, .format = format, .size = size};
}

glm::vec4 rounded_to_half(glm::vec4 v) {
    return glm::unpackHalf4x16(glm::packHalf4x16(v));
}

float mean_of(const SkyLight& light) {
    return light[0].x + light[1].x + light[2].x;
}

}  // namespace

bool has_static_casters(const GpuScene& gpu) {
    return std::ranges::any_of(gpu.instances(), [&](const Instance& i) {
        return i.cast_shadow && !i.dynamic && !gpu.material(i.material).alpha_blend;
    });
}

SkyVolumePass::SkyVolumePass(ShaderLibrary& shaders)
    : shaders_(shaders), depth_(shaders), compare_({.compare = true}, "sky depth maps") {}

void SkyVolumePass::release(FrameContext& frame, const char* reason) {
    for (int level = 0; level < SKY_LEVELS; ++level) frame.passes.skip(pass_name(level), reason);
    for (gl::Texture* texture : {&volume_, &sums_, &links_, &maps_}) *texture = {};
    map_framebuffers_.clear();
    levels_ = {};
    building_ = -1;
}

/// One level if the scene fits in; else those round the eye stay where they are until it is a quarter of their size
/// off their middle.
void SkyVolumePass::place_levels(const FrameContext& frame) {
    if (!has_static_casters(frame.gpu)) {
        cells_ = glm::ivec3(1);
        level_count_ = 1;
        levels_[0].place = {};
        return;
    }
    const Aabb casters = static_bounds(frame.gpu.instances(), frame.scene.bounds);
    const int across = frame.settings.sky_cells;
    const glm::ivec3 most(across, 3 * across / 4, across);
    const float finest = frame.settings.sky_cell;
    const glm::vec3 extent = casters.max - casters.min;
    const auto holds_all = [&](int count) {
        return glm::all(glm::lessThanEqual(
            extent, glm::vec3(most - 4) * (finest * static_cast<float>(std::pow(growth, count - 1)))));
    };
    level_count_ = 1;
    while (level_count_ < SKY_LEVELS && !holds_all(level_count_)) ++level_count_;
    cells_ = level_count_ == 1 ? glm::min(glm::ivec3(glm::ceil(extent / finest)) + 4, most) : most;
    float cell = finest;
    for (int i = 0; i < level_count_; ++i, cell *= growth) {
        const glm::vec3 size = glm::vec3(cells_ - 1) * cell;
        Place& place = levels_[static_cast<std::size_t>(i)].place;
        const bool near =
            glm::all(glm::lessThanEqual(glm::abs(frame.view.eye - (place.low + 0.5f * size)), 0.25f * size));
        const glm::vec3 first = casters.min - 2 * cell, last = glm::max(casters.max + cell - size, first);
        const bool inside = glm::clamp(place.low, first, last + cell) == place.low && place.cell == cell;
        if (near && inside) continue;
        const glm::vec3 center = glm::round(frame.view.eye / (4 * cell)) * (4 * cell);
        place = {glm::clamp(center - 0.5f * size, first, last), cell};
        if (level_count_ == 1) place.low = glm::floor(0.5f * (casters.min + casters.max - size) / cell) * cell;
        place.low += off_lattice * cell;
    }
}

void SkyVolumePass::resize(int directions) {
    if (directions_ != directions) {
        directions_ = directions;
        sky_key_ = 0;
        building_ = -1;
    }
    const gl::TextureDesc volume = volume_desc(GL_RGBA16F, {cells_.x, cells_.y, 3 * cells_.z * level_count_ + 3});
    if (volume_ && volume_.desc() == volume) return;
    volume_ = gl::Texture(volume, "sky volume");
    for (Level& level : levels_) level.shown_key = 0, level.shown = {.cell = 0};
    building_ = -1;
    if (cells_ == glm::ivec3(1)) return;
    sums_ = gl::Texture(volume_desc(GL_RGBA16F, {cells_.x, cells_.y, 3 * cells_.z}), "sky volume sums");
    links_ = gl::Texture(volume_desc(GL_R32UI, cells_), "sky volume links");
    const int side = std::max(texels_per_cell * std::max({cells_.x, cells_.y, cells_.z}), 64);
    maps_ = gl::Texture({gl::TextureKind::d2_array, GL_DEPTH_COMPONENT32F, {side, side, map_count}, 1},
                        "sky depth maps");
    map_framebuffers_.clear();
    std::size_t bytes = 0;
    for (const gl::Texture* texture : {&volume_, &sums_, &links_, &maps_}) bytes += byte_size(texture->desc());
    TYNDALL_CHECK_LE(bytes, most_bytes);
    for (int layer = 0; layer < map_count; ++layer) {
        const gl::Attachment depth{.texture = maps_, .layer = layer};
        map_framebuffers_.emplace_back(std::span<const gl::Attachment>(), &depth, "sky depth map");
    }
}

void SkyVolumePass::fill_frame(FrameContext& frame) const {
    for (int i = 0; i < SKY_LEVELS; ++i) {
        const Level& level = levels_[static_cast<std::size_t>(i)];
        // What is not there yet lies nowhere near.
        frame.frame.sky_level[i] = i < level_count_ && level.shown.cell > 0
                                       ? glm::vec4(level.shown.low, 1 / level.shown.cell)
                                       : glm::vec4(1e30f, 1e30f, 1e30f, 1);
    }
    frame.frame.sky_cells = glm::vec4(cells_, level_count_);
}

TextureRef SkyVolumePass::add(FrameContext& frame, TextureRef sky, std::uint64_t sky_key) {
    if (!frame.facts.sky_visibility) {
        release(frame, !frame.facts.has_ambient         ? "ambient light is off"
                       : !frame.settings.sky_visibility ? "sky_visibility is off"
                                                        : "nothing tells places or directions apart");
        return {};
    }
    place_levels(frame);
    resize(frame.settings.sky_directions);
    ShadowKey common;
    common.add(sky_key);
    common.add(ShadowCasters(frame.scene, frame.gpu).static_key());
    common.add(static_cast<std::uint64_t>(directions_));
    TextureRef volume = frame.passes.import("sky volume", volume_);
    int left = frame.progressive ? directions_a_frame : std::numeric_limits<int>::max();
    for (int i = SKY_LEVELS - 1; i >= 0; --i) {
        Level& level = levels_[static_cast<std::size_t>(i)];
        if (i >= level_count_) {
            frame.passes.skip(pass_name(i), "finer levels hold the scene");
            continue;
        }
        ShadowKey key = common;
        key.add(glm::vec4(level.place.low, level.place.cell));
        level.key = key.value();
        if (level.key == level.shown_key) {
            frame.passes.skip(pass_name(i), "unchanged since it was built");
            continue;
        }
        if (left == 0) {
            frame.passes.skip(pass_name(i), "waits for a coarser one");
            continue;
        }
        const bool begins = building_ != i || building_key_ != level.key;
        building_ = i;
        building_key_ = level.key;
        if (begins) gathered_ = 0;
        const int all = directions_, first = gathered_;
        const int count = cells_ == glm::ivec3(1) ? all : std::min(left, all - first);
        left -= std::min(left, count);
        gathered_ += count;
        const bool ends = gathered_ == all;
        // The first ones are shown while they are gathered.
        const bool shows = ends || level.shown_key == 0;
        if (shows) level.shown = level.place;
        if (ends) {
            level.shown_key = level.key;
            building_ = -1;
        }
        frame.passes.add(
            pass_name(i),
            [&](PassBuilder& pass) {
                pass.sample(sky);
                volume = pass.storage_read_write(volume);
                pass.keep();
            },
            [this, &frame, &level, sky, sky_key, i, begins, first, count, shows](const PassContext& pass) {
                read_sky(pass.texture(sky).id, sky_key);
                if (cells_ == glm::ivec3(1)) {
                    const SkyLight open = sum_of_light(sky_);
                    std::array<glm::vec4, 6> texels;
                    for (std::size_t c = 0; c < texels.size(); ++c) texels[c] = rounded_to_half(open[c % 3]);
                    volume_.upload(0, GL_RGBA, GL_FLOAT, texels.data());
                    return;
                }
                if (begins) begin(frame, level);
                for (int part = first; part < first + count; part += map_count)
                    gather(frame, level, part, std::min(map_count, first + count - part));
                if (!shows) return;
                const int last = first + count;
                const auto done = std::span(sky_).first(static_cast<std::size_t>(last));
                spread(i, mean_of(sum_of_light(sky_)) / std::max(mean_of(sum_of_light(done)), 1e-30f));
            });
    }
    fill_frame(frame);
    return volume;
}

void SkyVolumePass::read_sky(GLuint cube, std::uint64_t key) {
    if (key == sky_key_) return;
    sky_key_ = key;
    int size = 0;
    glGetTextureLevelParameteriv(cube, sky_mip, GL_TEXTURE_WIDTH, &size);
    std::vector<glm::vec4> texels(static_cast<std::size_t>(6 * size * size));
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(cube, sky_mip, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(texels.size() * sizeof texels[0]),
                      texels.data());
    sky_ = share_sky(texels, size, directions_);
}

/// Empties the sums and finds the surfaces between neighbouring cells.
void SkyVolumePass::begin(const FrameContext& frame, const Level& level) {
    sums_.clear_float(0, 0, 0, 0);
    constexpr GLuint none = 0;
    glClearTexImage(links_.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    draws_.build(frame.gpu, Frustum{}, DrawList::Filter::static_shadow_casters);
    map_framebuffers_[0].bind();  // nothing is written to it
    glBindImageTexture(0, links_.id(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
    gl::apply({.color_write = false});
    const gl::Program& shader = shaders_.get(links_program);
    shader.set("low", level.place.low);
    shader.set("per_cell", 1 / level.place.cell);
    shader.set("cells", cells_);
    for (int axis = 0; axis < 3; ++axis) {
        glViewport(0, 0, cells_[(axis + 1) % 3], cells_[(axis + 2) % 3]);
        shader.set("axis", axis);
        draws_.draw(frame.gpu, [&](DrawList::Surfaces surfaces) {
            const GpuScene::GpuMaterial& material = frame.gpu.material(surfaces.material);
            if (material.alpha_mask) return false;  // leaves are no wall
            glFrontFace(surfaces.mirrored ? GL_CW : GL_CCW);
            shader.set("both_sides", static_cast<int>(material.double_sided));
            shader.use();
            return true;
        });
    }
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void SkyVolumePass::gather(const FrameContext& frame, const Level& level, int first, int count) {
    const glm::vec3 low = level.place.low, high = low + glm::vec3(cells_ - 1) * level.place.cell;
    std::vector<shared::SkyDirection> directions;
    for (const SkyPart& part :
         std::span(sky_).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count))) {
        if (mean_of(part.light) <= 0) continue;
        const SunMap map = fit_static({low, high}, -part.direction, maps_.size().x);
        draws_.build(frame.gpu, caster_volume(map), DrawList::Filter::static_shadow_casters);
        map_framebuffers_[directions.size()].bind();
        gl::apply(ShadowDepth::state());
        glClearDepthf(0);
        glClear(GL_DEPTH_BUFFER_BIT);
        depth_.draw(frame.gpu, draws_, 0, world_to_clip(map), true);
        directions.push_back({map.world_to_texture, part.light[0], part.light[1], part.light[2]});
    }
    if (directions.empty()) return;
    direction_buffer_.assign(std::span<const shared::SkyDirection>(directions), "sky directions");
    direction_buffer_.bind(GL_SHADER_STORAGE_BUFFER, 0);
    const gl::Program& shader = shaders_.get(gather_program);
    shader.set("cells", cells_);
    shader.set("low", low);
    shader.set("size", level.place.cell);
    shader.set("count", static_cast<int>(directions.size()));
    shader.use();
    glBindTextureUnit(0, maps_.id());
    glBindSampler(0, compare_.id());
    glBindImageTexture(0, sums_.id(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA16F);
    const glm::uvec3 groups((cells_ + 3) / 4);
    glDispatchCompute(groups.x, groups.y, groups.z);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    glBindSampler(0, 0);
}

void SkyVolumePass::spread(int level, float scale) const {
    const SkyLight open = sum_of_light(sky_);
    const float darkest = dark_share * mean_of(open);
    glBindImageTexture(0, sums_.id(), 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA16F);
    glBindImageTexture(1, links_.id(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
    glBindImageTexture(2, volume_.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    const glm::uvec3 groups((cells_ + 3) / 4);
    for (const ProgramDesc* program : {&solid_program, &spread_program}) {
        const gl::Program& shader = shaders_.get(*program);
        shader.set("cells", cells_);
        shader.set("darkest", darkest);
        shader.set("first_layer", 3 * cells_.z * level);
        shader.set("open_layer", 3 * cells_.z * level_count_);
        shader.set("scale", scale);
        shader.set("open_red", open[0]);
        shader.set("open_green", open[1]);
        shader.set("open_blue", open[2]);
        shader.use();
        glDispatchCompute(groups.x, groups.y, groups.z);
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    }
}

void SkyVolumePass::bind() const {
    glBindTextureUnit(UNIT_AMBIENT, volume_.id());
}

}  // namespace tyndall
