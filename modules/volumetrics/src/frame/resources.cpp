#include "frame/resources.h"

#include "media/froxel_tiles.h"

namespace tyndall::volumetrics {

void Resources::upload(const Settings& settings, FrameMedia& media) {
    if (!nearest.id()) {
        nearest = gl::Sampler({.min_filter = GL_NEAREST, .mag_filter = GL_NEAREST}, "volumetrics nearest");
        linear = gl::Sampler({}, "volumetrics linear");
    }
    uniforms.assign(std::span<const shared::VolumetricsData>(&media.data, 1), "volumetrics uniforms");
    if (media.local.empty())
        local_media = {};
    else
        local_media.assign(std::span<const shared::LocalMedium>(media.local), "volumetrics local media");
    if (media.local_froxels.empty()) {
        media_tiles = {};
    } else {
        const glm::ivec3 froxels{settings.froxels_x, settings.froxels_y, settings.froxels_z};
        const std::vector<std::uint32_t> tiles = live_tiles(media.local_froxels, froxels);
        media.live_tiles = tiles.size() / (1 + (media.local_froxels.size() + 31) / 32);
        media_tiles.assign(std::span<const std::uint32_t>(tiles), "volumetrics media tiles");
    }
    noise.prepare(settings);
}

void Resources::release() {
    uniforms = {};
    local_media = {};
    media_tiles = {};
    light_volumes.release();
    noise.release();
    temporal.release();
}

std::size_t Resources::bytes() const {
    return uniforms.size() + local_media.size() + media_tiles.size() + light_volumes.bytes() + noise.bytes() +
           temporal.bytes();
}

}  // namespace tyndall::volumetrics
