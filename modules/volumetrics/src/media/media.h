#pragma once

#include <limits>
#include <vector>

#include "engine/shader/shader_library.h"
#include "media/grid_atlas.h"
#include "shaders/shared/volumetrics.h"
#include "volumetrics/inputs.h"
#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// Of a local medium: view depths [m] and bounds on the screen (0..1); the whole screen where it reaches behind the
/// eye.
struct ViewBounds {
    float nearest = std::numeric_limits<float>::max(), farthest = std::numeric_limits<float>::lowest();
    glm::vec2 lower{std::numeric_limits<float>::max()}, upper{std::numeric_limits<float>::lowest()};
    /// Some of it may be seen.
    [[nodiscard]] bool in_view() const;
};

/// A range of froxels, or of texels: lower corner included, upper not.
struct IndexBox {
    glm::ivec3 lower{0}, upper{0};
    [[nodiscard]] bool empty() const { return lower.x >= upper.x || lower.y >= upper.y || lower.z >= upper.z; }
};

/// A local medium that dims light on its way, in view or not.
struct AttenuatingMedium {
    LocalMedium medium;
    shared::LocalMedium packed;  ///< without emission: equal bytes dim alike
};

/// What one frame's inputs come to: media that do nothing are left out, and so are local media out of view, but for
/// the technique reference, where they may stand between a light and what is seen.
struct FrameMedia {
    shared::VolumetricsData data{};
    std::vector<shared::LocalMedium> local;
    std::vector<ViewBounds> local_bounds;        ///< of each
    std::vector<IndexBox> local_froxels;         ///< that each may touch
    std::vector<Lamp> few_lamps;                 ///< of techniques with the trait of that name
    std::vector<AttenuatingMedium> attenuating;  ///< none where light_transmittance is off or no sun or lamp shines
    bool has_global = false;
    bool local_emission = false;
    bool local_noise = false;
    Grids grids;              ///< of all inputs
    bool uses_grids = false;  ///< one of them may be seen, or its shadow; else they are left out
    int glass = 0;            ///< GLASS_SUN, GLASS_LAMPS: whose light has its colours
    bool rayleigh = false;    ///< some medium scatters as air does
    bool chromatic = false;   ///< some medium's extinction is coloured, or is taken so, for fewer programs: always
                              ///< where `rayleigh`

    [[nodiscard]] bool empty() const { return !has_global && local.empty(); }
};

/// Whether it stands for a further sun.
[[nodiscard]] bool is_sun(const Lamp& lamp, glm::vec3 eye);

/// Whether it can occur: with GRIDS, other axes of media have but their last value.
[[nodiscard]] bool is_grid_permutation(const Permutation& permutation);

/// Whether it can occur: with GLASS, other axes of media have but the values that serve all, see Frame::program.
[[nodiscard]] bool is_glass_permutation(const Permutation& permutation);

/// Value of the axis HEIGHT_MEDIA: see shaders/volumetrics/media/global_media.glsl.
[[nodiscard]] int height_media_axis(const FrameMedia& media);

/// Throws Error for more than MAX_HEIGHT_MEDIA height media.
[[nodiscard]] FrameMedia gather_media(const Inputs& inputs, const Settings& settings);

}  // namespace tyndall::volumetrics
