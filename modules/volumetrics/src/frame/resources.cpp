#include "frame/resources.h"

#include "engine/gl/program_limits.h"
#include "media/froxel_tiles.h"
#include "reconstruction/reconstruction.h"

namespace tyndall::volumetrics {

void Resources::upload(const Settings& settings, FrameMedia& media, const Roots& roots) {
    media.data.loop_rounds = gl::loop_rounds();
    if (!nearest.id()) {
        nearest = gl::Sampler({.min_filter = GL_NEAREST, .mag_filter = GL_NEAREST}, "volumetrics nearest");
        linear = gl::Sampler({}, "volumetrics linear");
    }
    uniforms.assign(std::span<const shared::VolumetricsData>(&media.data, 1), "volumetrics uniforms");
    if (resolution_factor(settings) > 1 && media.uses_grids) {
        shared::VolumetricsData host = media.data;
        host.target = host.viewport;
        host_uniforms.assign(std::span<const shared::VolumetricsData>(&host, 1), "volumetrics host uniforms");
    } else {
        host_uniforms = {};
    }
    if (media.local.empty()) {
        for (gl::Buffer* buffer : {&local_media, &screen_media, &media_tiles}) *buffer = {};
    } else {
        local_media.assign(std::span<const shared::LocalMedium>(media.local), "volumetrics local media");
        screen_media.assign(std::span<const std::uint32_t>(volumetrics::screen_media(media.local_bounds)),
                            "volumetrics media of the screen");
    }
    if (media.uses_grids || media.grids.empty()) grids.prepare(media.grids);
    noise.prepare(settings, roots);
}

void Resources::release(const FrameMedia& media) {
    for (gl::Buffer* buffer :
         {&uniforms, &host_uniforms, &local_media, &screen_media, &media_tiles, &transparent_depths})
        *buffer = {};
    if (media.grids.empty()) {
        grids.release();
        light_volumes.release();
    }
    noise.release();
    temporal.release();
}

std::size_t Resources::bytes() const {
    return uniforms.size() + host_uniforms.size() + local_media.size() + screen_media.size() + media_tiles.size() +
           transparent_depths.size() + grids.bytes() + light_volumes.bytes() + noise.bytes() + temporal.bytes();
}

}  // namespace tyndall::volumetrics
