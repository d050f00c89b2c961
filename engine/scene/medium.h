#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/aabb.h"
#include "engine/scene/density_grid.h"

namespace tyndall {

/// One entry of a media list, as in a media file or a scene's extras.media. Coefficients in 1/m at density 1.
struct Medium {
    enum class Shape { global, height, sphere, ellipsoid, box, grid };
    Shape shape = Shape::global;
    glm::vec3 sigma_s{0}, sigma_a{0};
    float anisotropy = 0;   ///< g in (-1, 1); g > 0 scatters forward
    glm::vec3 emission{0};  ///< emitted radiance per metre
    bool rayleigh = false;  ///< global and height: Rayleigh's phase function, as air; then anisotropy is 0
    glm::vec3 center{0};
    glm::vec3 half_extent{1};  ///< radii, half edges of a box; m
    glm::quat rotation{1, 0, 0, 0};
    float softness = 0;      ///< m; linear ramp at the rim, inside the shape
    float noise_scale = 0;   ///< m per period; 0 = no noise
    float noise_amount = 0;  ///< 0..1
    int noise_seed = 0;
    bool height_profile = false;  ///< shape height, or a bounded shape with "height"
    float base = 0, falloff = 1;  ///< density exp(-(y - base) / falloff), m

    // Shape grid: the density at world = center + rotation * (scale * (index_to_grid * voxel)) is that of the voxel
    // times `density`. Softness, noise and height profile do not apply, nor does half_extent.
    std::shared_ptr<const DensityGrid> grid = nullptr;
    float scale = 1, density = 1;
    bool nearest = false;          ///< the voxel's value all over its cube; else trilinear between voxel centres
    glm::vec3 wind{0};             ///< m/s: animate() moves the centre
    glm::vec3 center_at_start{0};  ///< at time 0
};

/// Shape grid: voxel coordinates to world.
[[nodiscard]] glm::dmat4 index_to_world(const Medium& grid);

/// As media files call it.
[[nodiscard]] std::string_view name_of(Medium::Shape shape);
/// Else it fills space.
[[nodiscard]] bool is_bounded(const Medium& medium);
/// Some are density grids of 100 m or more: clouds, in the place of those that the sky paints.
[[nodiscard]] bool has_clouds(const std::vector<Medium>& media);
/// Of a bounded medium, and not too small: those of the box round it.
[[nodiscard]] Aabb world_bounds(const Medium& bounded);

/// Parses {"media": [...]} or the bare list. `where` starts each message: path and index ("fog.json:
/// media[2].radius: …"). `albedo` and `extinction` may stand for scattering and absorption. Unknown keys, wrong
/// types, non-finite numbers, coefficients outside 0 to 1e6 1/m, |g| >= 1, places beyond 1e9 m, sizes outside 1e-6
/// to 1e9 m are errors; so is a "phase" other than "mie" (particles, the phase function of the settings) and
/// "rayleigh" (air: no anisotropy, only in media that fill space). Files of grids are relative to `folder` and lie
/// inside it; one that several media name is read once.
[[nodiscard]] std::vector<Medium> parse_media(const nlohmann::json& json, const std::string& where,
                                              const std::filesystem::path& folder);
/// One entry of such a list; `where` is it.
[[nodiscard]] Medium parse_medium(const nlohmann::json& json, const std::string& where,
                                  const std::filesystem::path& folder);
[[nodiscard]] std::vector<Medium> load_media(const std::filesystem::path& path);

}  // namespace tyndall
