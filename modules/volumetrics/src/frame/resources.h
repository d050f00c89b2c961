#pragma once

#include <cstdint>
#include <optional>

#include "engine/gl/buffer.h"
#include "engine/gl/sampler.h"
#include "light/light_volume.h"
#include "media/froxel_media.h"
#include "media/grid_atlas.h"
#include "media/media.h"
#include "reconstruction/noise.h"
#include "reconstruction/temporal.h"

namespace tyndall::volumetrics {

/// What the passes of all techniques share.
struct Resources {
    gl::Sampler nearest, linear;
    gl::Buffer uniforms, local_media, screen_media, media_tiles, transparent_depths;
    gl::Buffer
        host_uniforms;  ///< of passes at the host's size, where others have a lower one and grids may be in view
    GridAtlas grids;
    LightVolumes light_volumes;
    NoiseSource noise;
    std::uint64_t prepared = 0;  ///< calls of Volumetrics::prepare: passes run with what the last one uploaded
    TemporalHistory temporal;
    /// Textures of this frame, once a pass asked for them.
    struct ThisFrame {
        TextureRef froxel_columns;
        std::optional<FroxelMedia> froxel_media;
        std::optional<TextureRef> noise_volume;
    } this_frame;

    void upload(const Settings& settings, FrameMedia& media, const Roots& roots);
    /// No medium is in view: frees all but the samplers, and what is made of density grids while there are any.
    void release(const FrameMedia& media);
    [[nodiscard]] std::size_t bytes() const;  ///< held between frames
};

}  // namespace tyndall::volumetrics
