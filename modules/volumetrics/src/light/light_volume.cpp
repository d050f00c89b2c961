#include "light/light_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "media/shape.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc slabs_program{
    .name = "volumetrics/light_volume_slabs",
    .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/light/light_volume_slabs.comp"}},
    .axes = {{"LAMP", {0, 1}}, {"GRIDS", {0, 1}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramDesc sum_program{.name = "volumetrics/light_volume_sum",
                              .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/light/light_volume_sum.comp"}},
                              .axes = {{"CHROMATIC", {0, 1}}},
                              .valid = {}};
const ProgramRegistry::Registration slabs_registration(slabs_program), sum_registration(sum_program);

/// Texels of a group of the two; of the second, whole columns.
constexpr glm::ivec3 slabs_group{8, 8, 4}, sum_group{8, 8, 1 << 20};

void dispatch(const gl::Program& program, glm::ivec3 texels, glm::ivec3 group) {
    program.use();
    const glm::uvec3 groups((texels + group - 1) / group);
    glDispatchCompute(groups.x, groups.y, groups.z);
}

void add_slabs(const gl::Program& slabs, const DimmingMedia& media, const LightRays& r) {
    slabs.set("origin", r.origin);
    slabs.set("size", r.size);
    if (r.of_lamp()) {
        slabs.set("lamp_position", r.lamp);
        slabs.set("lamp_window", r.window);
        slabs.set("lamp_span", glm::vec2(r.begin, r.end));
    } else {
        slabs.set("volume_to_world", r.volume_to_world);
    }
    for (std::uint32_t i = r.first_medium; i < r.first_medium + r.media_count; ++i) {
        const IndexBox texels = dimmed_texels(r, media.all[i]);
        if (texels.empty()) continue;
        slabs.set("medium_index", i);
        slabs.set("first_texel", texels.lower);
        slabs.set("end_texel", texels.upper);
        dispatch(slabs, texels.upper - texels.lower, slabs_group);
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
}

bool is_grid(const AttenuatingMedium& medium) {
    return medium.medium.shape == Shape::grid;
}

bool is_active(const GridSunVolumes& volumes) {
    return volumes.active();
}
bool is_active(const auto& volume) {
    return static_cast<bool>(volume.texture());
}

/// The media, grids last; and the grids once more, as their density alone.
std::vector<shared::LocalMedium> packed(const FrameMedia& media) {
    std::vector<shared::LocalMedium> all;
    for (const AttenuatingMedium& medium : media.attenuating) all.push_back(medium.packed);
    for (const AttenuatingMedium& medium : dimming_grids(media)) {
        all.push_back(medium.packed);
        all.back().sigma_s_g = {1, 1, 1, 0};
        all.back().sigma_a_shape = {0, 0, 0, all.back().sigma_a_shape.w};
    }
    return all;
}

}  // namespace

std::span<const AttenuatingMedium> dimming_shapes(const FrameMedia& media) {
    return {media.attenuating.begin(), std::ranges::find_if(media.attenuating, is_grid)};
}

std::span<const AttenuatingMedium> dimming_grids(const FrameMedia& media) {
    return {std::ranges::find_if(media.attenuating, is_grid), media.attenuating.end()};
}

gl::Texture light_volume_texture(glm::ivec3 size, bool chromatic, const char* label) {
    gl::Texture texture({.kind = gl::TextureKind::d3,
                         .format = static_cast<GLenum>(chromatic ? GL_RGBA16F : GL_R16F),
                         .size = size,
                         .levels = 1},
                        label);
    constexpr GLint grey[4] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    if (!chromatic) glTextureParameteriv(texture.id(), GL_TEXTURE_SWIZZLE_RGBA, grey);
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(texture.id(), axis, GL_CLAMP_TO_EDGE);
    return texture;
}

IndexBox dimmed_texels(const LightRays& rays, const shared::LocalMedium& medium) {
    const glm::vec3 center = glm::inverse(medium.world_to_shape)[3];
    glm::vec3 lower(0), upper(rays.size);  // in texels from the first one's near side
    if (rays.of_lamp()) {
        const float radius = glm::length(glm::vec3(medium.extent_softness)),
                    from = glm::distance(center, rays.lamp);
        const float texels = static_cast<float>(rays.size.z - 1) / (rays.end - rays.begin);
        lower.z = (from - radius - rays.begin) * texels + 0.5f;
        upper.z = (from + radius - rays.begin) * texels + 0.5f;
    } else {
        const glm::vec3 at = glm::inverse(rays.volume_to_world) * glm::vec4(center, 1);
        for (int axis = 0; axis < 3; ++axis) {
            const auto side = glm::vec3(rays.volume_to_world[axis]);
            const float length = glm::length(side), size = static_cast<float>(rays.size[axis]);
            const float half = half_extent_along(medium, side / length) / length;
            lower[axis] = (at[axis] - half) * size;
            upper[axis] = (at[axis] + half) * size;
        }
    }
    // A slab ends at its texel's centre and begins at that of the one before it. A texel more all round: rounding
    // never loses one.
    // Where numbers are beyond all bounds, all texels: fmin and fmax take the one that is a number.
    IndexBox texels;
    for (int axis = 0; axis < 3; ++axis) {
        const auto size = static_cast<float>(rays.size[axis]), slab = axis == 2 ? 1.0f : 0.0f;
        texels.lower[axis] = static_cast<int>(std::fmin(std::fmax(std::floor(lower[axis] - 1), 0.0f), size));
        texels.upper[axis] = static_cast<int>(std::fmax(std::fmin(std::ceil(upper[axis] + 1) + slab, size), 0.0f));
    }
    return texels;
}

void fill_light_volume(ShaderLibrary& shaders, bool count_work, const gl::Texture& volume,
                       const DimmingMedia& media, std::span<const LightRays> rays) {
    const bool chromatic = volume.desc().format == GL_RGBA16F;
    glBindImageTexture(0, volume.id(), 0, GL_TRUE, 0, GL_READ_WRITE, volume.desc().format);
    media.buffer.bind(GL_SHADER_STORAGE_BUFFER, BINDING_LOCAL_MEDIA);
    media.grids.bind();
    for (const LightRays& r : rays) {
        const gl::Program& slabs = shaders.get(slabs_program, {{"LAMP", r.of_lamp()},
                                                               {"GRIDS", media.has_grids},
                                                               {"CHROMATIC", chromatic},
                                                               {"COUNT_WORK", count_work}});
        glClearTexSubImage(volume.id(), 0, r.origin.x, r.origin.y, r.origin.z, r.size.x, r.size.y, r.size.z,
                           GL_RGBA, GL_FLOAT, nullptr);
        add_slabs(slabs, media, r);
    }
    const gl::Program& sum = shaders.get(sum_program, {{"CHROMATIC", chromatic}});
    for (const LightRays& r : rays) {
        sum.set("origin", r.origin);
        sum.set("size", r.size);
        dispatch(sum, r.size, sum_group);
    }
}

void LightVolumes::prepare(const Inputs& inputs, const Settings& settings, FrameMedia& media) {
    sun_ref_ = grid_suns_ref_ = lamps_ref_ = {};
    if (!nothing_ && !(media.empty() && media.attenuating.empty())) {
        nothing_ = light_volume_texture({1, 1, 1}, false, "volumetrics light volume of nothing");
        nothing_.clear_float(0, 0, 0, 0);
        const glm::vec4 no_lamp[2] = {glm::vec4(-1), glm::vec4(0)};
        no_lamps_ = gl::Buffer::of(std::span<const glm::vec4>(no_lamp), "volumetrics lamp volume table of none");
    }
    std::ranges::stable_partition(media.attenuating, std::not_fn(is_grid));
    grid_suns_.prepare(inputs, settings, media);
    if (media.attenuating.empty()) return release_volumes(media);
    sun_.prepare(inputs, settings, media);
    lamps_.prepare(inputs, settings, media);
    if (!any()) return release_volumes(media);
    const std::vector<shared::LocalMedium> now = packed(media);
    if (now.size() == uploaded_.size() &&
        std::memcmp(now.data(), uploaded_.data(), now.size() * sizeof now[0]) == 0)
        return;
    media_.assign(std::span<const shared::LocalMedium>(now), "volumetrics light-dimming media");
    uploaded_ = now;
}

void LightVolumes::add_passes(PassList& passes, ShaderLibrary& shaders, const Inputs& inputs,
                              const GridAtlas& grids) {
    const bool has_grids = std::ranges::any_of(
        uploaded_, [](const shared::LocalMedium& m) { return m.sigma_a_shape.w == SHAPE_GRID; });
    const auto add = [&](const char* name, auto& volume, const char* without) {
        if (!is_active(volume)) {
            passes.skip(name, without);
            return TextureRef();
        }
        TextureRef ref = passes.import(name, volume.texture());
        if (!volume.stale()) {
            passes.skip(name, "neither the local media nor the light changed");
            return ref;
        }
        passes.add(
            name, [&](PassBuilder& builder) { ref = builder.storage_write(ref); },
            [this, &volume, &shaders, &grids, has_grids, count_work = inputs.count_work](const PassContext&) {
                volume.fill(shaders, count_work, {uploaded_, media_, has_grids, grids});
            });
        return ref;
    };
    sun_ref_ = add("volumetrics/sun_volume", sun_, "no local medium dims a sun");
    grid_suns_ref_ =
        add("volumetrics/grid_sun_volume", grid_suns_, "no density grid in view, nor the shadow of one");
    lamps_ref_ = add("volumetrics/lamp_volumes", lamps_, "no lamp in view reaches a local medium");
    if (lamps_.left_out() > 0)
        passes.skip(
            "volumetrics/lamp_volumes of the others",
            fmt::format("{} lamps more than lamp_volume_count: local media do not dim them", lamps_.left_out()));
}

void LightVolumes::release_volumes(const FrameMedia& media) {
    sun_.release();
    if (media.grids.empty()) grid_suns_.release();
    lamps_.release();
    media_ = {};
    uploaded_.clear();
}

void LightVolumes::sample(PassBuilder& builder) const {
    builder.sample(sun_ref_);
    builder.sample(grid_suns_ref_);
    builder.sample(lamps_ref_);
}

void LightVolumes::bind() const {
    if (!nothing_) return;
    const auto bind_texture = [this](GLuint unit, const gl::Texture& volume) {
        glBindTextureUnit(unit, (volume ? volume : nothing_).id());
        glBindSampler(unit, 0);
    };
    bind_texture(UNIT_SUN_VOLUME, sun_.texture());
    bind_texture(UNIT_GRID_SUN, grid_suns_.texture());
    bind_texture(UNIT_LAMP_VOLUMES, lamps_.texture());
    (lamps_.table() ? lamps_.table() : no_lamps_).bind(GL_SHADER_STORAGE_BUFFER, BINDING_LAMP_VOLUMES);
}

std::size_t LightVolumes::bytes() const {
    std::size_t bytes = media_.size() + lamps_.table().size() + no_lamps_.size();
    for (const gl::Texture* texture : {&sun_.texture(), &grid_suns_.texture(), &lamps_.texture(), &nothing_})
        if (*texture) bytes += gl::byte_size(texture->desc());
    return bytes;
}

bool is_light_volume_permutation(const Permutation& permutation) {
    const auto found = permutation.find("LIGHT_VOLUMES");
    if (found == permutation.end() || found->second == 0) return true;
    const auto grids = permutation.find("GRIDS");
    if (found->second == 2 && grids != permutation.end() && grids->second == 0) return false;
    const auto sun = permutation.find("HAS_SUN"), lamps = permutation.find("LAMPS");
    return (sun != permutation.end() && sun->second != 0) || (lamps != permutation.end() && lamps->second != 0);
}

}  // namespace tyndall::volumetrics
