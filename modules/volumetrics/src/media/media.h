#pragma once

#include <vector>

#include "shaders/shared/volumetrics.h"
#include "volumetrics/inputs.h"
#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// A range of froxels: lower corner included, upper not.
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
    /// That each local medium may touch; none for the reference without transparents.
    std::vector<IndexBox> local_froxels;
    std::size_t live_tiles = 0;                  ///< of the froxel volume: entries of live_tiles()
    std::vector<AttenuatingMedium> attenuating;  ///< none where light_transmittance is off or no sun or lamp shines
    bool has_global = false;
    bool local_emission = false;
    bool rayleigh = false;   ///< some medium scatters as air does
    bool chromatic = false;  ///< some medium's extinction is coloured, or is taken so: always where `rayleigh`

    [[nodiscard]] bool empty() const { return !has_global && local.empty(); }
};

/// Value of the axis HEIGHT_MEDIA: see shaders/volumetrics/media/global_media.glsl.
[[nodiscard]] int height_media_axis(const FrameMedia& media);

/// Throws Error for more than MAX_HEIGHT_MEDIA height media.
[[nodiscard]] FrameMedia gather_media(const Inputs& inputs, const Settings& settings);

}  // namespace tyndall::volumetrics
