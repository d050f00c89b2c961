#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "light/light_volume.h"
#include "media/shape.h"

namespace tyndall::volumetrics {
namespace {

/// Texels of a part: two for each voxel that it spans across the light, one along it, times the detail, up to a
/// limit.
glm::ivec3 part_size(const AttenuatingMedium& grid, glm::dvec3 direction, const LightVolumeSettings& settings) {
    double voxels = 0;  // along an axis, a metre
    for (const glm::vec4 row : {grid.packed.grid_x, grid.packed.grid_y, grid.packed.grid_z})
        voxels = std::max(voxels, double(glm::length(glm::vec3(row))));
    const glm::dmat3 axes = sun_axes(direction);
    const auto spanned = [&](int axis) { return 2 * half_extent_along(grid.medium, axes[axis]) * voxels; };
    const auto texels = [&](double wanted) {
        return static_cast<int>(
            std::clamp(std::ceil(settings.grid_detail * wanted), 4.0, double(settings.grid_size)));
    };
    return {texels(2 * spanned(0) + 2), texels(2 * spanned(1) + 2), texels(spanned(2) + 1)};
}

}  // namespace

bool GridSunVolumes::stale() const {
    return std::ranges::find(fresh_, false) != fresh_.end();
}

void GridSunVolumes::prepare(const Inputs& inputs, const Settings& settings, FrameMedia& media) {
    const std::span<const AttenuatingMedium> grids = dimming_grids(media);
    active_ = inputs.has_sun && !grids.empty();
    if (!active_ && media.grids.empty()) return release();
    if (!active_) return;
    if (grids.size() > MAX_GRIDS)
        throw Error(fmt::format("volumetrics: {} density grids that dim light, at most {} expected", grids.size(),
                                MAX_GRIDS));
    const glm::vec3 direction =
        glm::dot(inputs.sun_direction, inputs.sun_direction) > 0 ? inputs.sun_direction : glm::vec3(0, -1, 0);

    std::vector<Part> parts;
    glm::ivec3 whole(0);
    for (const AttenuatingMedium& grid : grids) {
        const glm::ivec3 size = part_size(grid, direction, settings.light_volumes);
        parts.push_back({grid.medium.grid,
                         glm::mat3(grid.medium.world_to_voxel),
                         grid.medium.nearest,
                         direction,
                         {0, 0, whole.z},
                         size});
        whole = {glm::max(glm::ivec2(whole), glm::ivec2(size)), whole.z + size.z};
    }
    if (!texture_ || texture_.desc().size != whole) {
        texture_ = light_volume_texture(whole, false, "volumetrics grid sun volume");
        parts_.clear();
    }
    fresh_.resize(parts.size());
    rays_.resize(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        fresh_[i] = i < parts_.size() && fresh_[i] && parts_[i] == parts[i];
        const glm::dvec3 size(parts[i].size), atlas(whole);
        const glm::dmat4 to_part = world_to_sun_box(grids.subspan(i, 1), direction, parts[i].size);
        rays_[i] = {.origin = parts[i].origin,
                    .size = parts[i].size,
                    .volume_to_world = glm::mat4(glm::inverse(to_part)),
                    .first_medium = static_cast<std::uint32_t>(media.attenuating.size() + i),
                    .media_count = 1};
        shared::GridSun& sun = media.data.grid_sun[i];
        glm::dmat4 to_volume(1);
        for (int axis = 0; axis < 3; ++axis) {
            to_volume[axis][axis] = size[axis] / atlas[axis];
            to_volume[3][axis] = parts[i].origin[axis] / atlas[axis];
        }
        sun.world_to_volume = glm::mat4(to_volume * to_part);
        sun.low = glm::vec4((glm::dvec3(parts[i].origin) + 0.5) / atlas, 0);
        sun.high = glm::vec4((glm::dvec3(parts[i].origin) + size - 0.5) / atlas, 0);
        sun.sigma_t = glm::vec4(grids[i].medium.sigma_s + grids[i].medium.sigma_a, 0);
    }
    media.data.grid_suns = static_cast<std::uint32_t>(parts.size());
    parts_ = std::move(parts);
}

void GridSunVolumes::fill(ShaderLibrary& shaders, bool count_work, const DimmingMedia& media) {
    std::vector<LightRays> stale;
    for (std::size_t i = 0; i < rays_.size(); ++i)
        if (!fresh_[i]) stale.push_back(rays_[i]);
    fill_light_volume(shaders, count_work, texture_, media, stale);
    fresh_.assign(fresh_.size(), true);
}

}  // namespace tyndall::volumetrics
