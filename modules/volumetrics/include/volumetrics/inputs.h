#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "engine/graph/pass_list.h"
#include "volumetrics/density_grid.h"

namespace tyndall::volumetrics {

struct Settings;

/// A medium that fills space. Coefficients in 1/m at density 1; density is 1, or exp(-(y - base) / falloff).
struct GlobalMedium {
    glm::vec3 sigma_s{0}, sigma_a{0};
    float anisotropy = 0;   ///< g in (-1, 1), > 0 is forward
    glm::vec3 emission{0};  ///< radiance per metre, in the unit of light of shaders/interface/lights.glsl
    bool rayleigh = false;  ///< scatters as air does, whatever Settings::phase; anisotropy is then not read
    bool height = false;
    float base = 0, falloff = 1;  ///< m
};

/// Of a bounded medium.
enum class Shape { ellipsoid, box, grid };

/// A medium bounded by a shape.
struct LocalMedium {
    Shape shape = Shape::ellipsoid;
    glm::vec3 center{0};       ///< m
    glm::vec3 half_extent{1};  ///< of the box round the shape, before it is turned: radii, half edge lengths; m
    glm::quat rotation{1, 0, 0, 0};
    float softness = 0;  ///< m: linear ramp at the rim, inside the shape
    glm::vec3 sigma_s{0}, sigma_a{0};
    float anisotropy = 0;
    glm::vec3 emission{0};
    float noise_scale = 0, noise_amount = 0;  ///< m; 0..1
    int noise_seed = 0;
    bool height = false;
    float base = 0, falloff = 1;
    // Shape grid: set_grid() fills these, centre, extent and rotation. It has no softness, noise or height.
    std::shared_ptr<const DensityGrid> grid = nullptr;
    glm::dmat4 world_to_voxel{1};
    bool nearest = false;
};

/// A lamp in view, by its index for light_at() of shaders/interface/lights.glsl. Suns beside Inputs::sun_direction
/// are lamps SUN_LAMP_DISTANCE away (shaders/shared/lights.h), with the indices from 0 on.
struct Lamp {
    std::uint32_t index = 0;
    glm::vec3 position{0};       ///< m
    float range = 0;             ///< m; 0: none
    glm::vec3 axis{0};           ///< unit, of a spot's cone
    float cos_outer = -1;        ///< of its half angle; -1: a point lamp
    bool shadow = true;          ///< casts one
    bool through_glass = false;  ///< glass may stand before what it lights: see Inputs::sun_through_glass
    float intensity = 1;         ///< mean channel, cd, in any unit that all lamps share: which of them matter most
};

/// m, in the world.
struct Box {
    glm::vec3 min{0}, max{0};
};

/// What the host gives each frame. All textures are borrowed.
struct Inputs {
    glm::mat4 view{1};        ///< world to view, right-handed, looks along -Z
    glm::mat4 projection{1};  ///< reversed-Z, infinite far, clip depth 0..1
    glm::vec3 eye{0};
    float znear = 0.1f;  ///< m
    glm::ivec2 size{0};  ///< px, of `depth`
    TextureRef depth;    ///< D32F or D32F_S8, reversed-Z
    /// RG16F, or empty: nothing moves but the camera. Of the surface seen: its place on the screen now less that in
    /// the frame before, 0..1 of the picture; the camera's motion included, as projected without jitter. Beyond
    /// -1..1: it was not in the picture. Not read where depth is 0, for there only the camera moves. Wanted where
    /// reads_motion() says so.
    TextureRef motion;

    std::vector<GlobalMedium> global;  ///< any number of homogeneous, at most 4 height media (Error otherwise)
    std::vector<LocalMedium> local;

    bool has_sun = false;
    glm::vec3 sun_direction{0, -1, 0};  ///< unit, in which its light travels: as sun_direction() in the shaders
    bool sun_shadow = true;             ///< casts one; read with has_shadow_maps alone
    bool has_lamps = false;             ///< local lights are in view
    std::vector<Lamp> lamps;            ///< those; local media do not attenuate the light of lamps left out; none
                                        ///< without has_lamps
    bool has_ambient = false;
    /// With has_ambient: that light differs from place to place, and shaders/interface/lights.glsl says how
    /// (ambient_radiance_at).
    bool has_sky_radiance = false;
    std::vector<TextureRef> light_textures;  ///< what shaders/interface/{lights,shadows}.glsl sample
    std::vector<BufferRef> light_buffers;    ///< and read
    std::function<void()> bind_lighting;     ///< binds those; called inside each pass that lights the medium
    /// Glass may stand between the sun and what is in view. Where it does, or before a lamp, (define GLASS)
    /// shaders/interface/shadows.glsl has sun_filter and light_filter.
    bool sun_through_glass = false;
    bool has_shadow_maps = false;  ///< the host has shaders/interface/shadow_maps.glsl

    /// Round all that is drawn over the picture and fogged: there Outputs::fog is wanted, whatever the technique.
    std::vector<Box> transparents;
    bool acceptance = false;  ///< Outputs::acceptance is wanted
    bool samples = false;     ///< Outputs::samples is wanted

    std::uint32_t frame_index = 0;
    double time = 0;          ///< s
    bool count_work = false;  ///< compile the instrumented permutations
};

/// Whether Inputs::motion changes anything: the technique is filtered over time along it.
[[nodiscard]] bool reads_motion(const Settings& settings);

}  // namespace tyndall::volumetrics
