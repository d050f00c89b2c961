#include <algorithm>
#include <cstring>
#include <limits>

#include "light/light_volume.h"
#include "media/shape.h"

namespace tyndall::volumetrics {

glm::dmat3 sun_axes(glm::dvec3 direction) {
    const glm::dvec3 z = glm::normalize(direction);
    const glm::dvec3 x =
        glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
    return {x, glm::cross(z, x), z};
}

glm::dmat4 world_to_sun_box(std::span<const AttenuatingMedium> media, glm::dvec3 direction, glm::ivec3 size) {
    const glm::dmat3 axes = sun_axes(direction);
    glm::dmat4 m(1);
    for (int i = 0; i < 3; ++i) {
        double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
        for (const AttenuatingMedium& medium : media) {
            const double center = glm::dot(axes[i], glm::dvec3(medium.medium.center));
            const double half = half_extent_along(medium.medium, axes[i]);
            low = std::min(low, center - half);
            high = std::max(high, center + half);
        }
        const double inner = i == 2 ? size[i] - 1 : size[i] - 2, outer = i == 2 ? 0.5 : 1;
        const double scale = inner / std::max(high - low, 1e-3);
        for (int row = 0; row < 3; ++row) m[row][i] = axes[i][row] * scale / size[i];
        m[3][i] = (outer - low * scale) / size[i];
    }
    return m;
}

namespace {

bool same(const std::vector<shared::LocalMedium>& before, std::span<const AttenuatingMedium> now) {
    return std::ranges::equal(before, now, [](const shared::LocalMedium& a, const AttenuatingMedium& b) {
        return std::memcmp(&a, &b.packed, sizeof a) == 0;
    });
}

}  // namespace

void SunVolume::prepare(const Inputs& inputs, const Settings& settings, FrameMedia& media) {
    const std::span<const AttenuatingMedium> dimming = dimming_shapes(media);
    if (!inputs.has_sun || dimming.empty()) return release();
    const int across = settings.light_volumes.sun_size;
    const glm::ivec3 size{across, across, std::max(across / 2, 2)};
    const bool resized =
        !texture_ || texture_.desc().size != size || (texture_.desc().format == GL_RGBA16F) != media.chromatic;
    if (resized) texture_ = light_volume_texture(size, media.chromatic, "volumetrics sun volume");
    if (resized || direction_ != inputs.sun_direction || !same(media_, dimming)) {
        const glm::dvec3 direction =
            glm::dot(inputs.sun_direction, inputs.sun_direction) > 0 ? inputs.sun_direction : glm::vec3(0, -1, 0);
        const glm::dmat4 to_volume = world_to_sun_box(dimming, direction, size);
        world_to_volume_ = glm::mat4(to_volume);
        rays_ = {.size = size,
                 .volume_to_world = glm::mat4(glm::inverse(to_volume)),
                 .media_count = static_cast<std::uint32_t>(dimming.size())};
        direction_ = inputs.sun_direction;
        media_.clear();
        for (const AttenuatingMedium& medium : dimming) media_.push_back(medium.packed);
        stale_ = true;
    }
    media.data.world_to_sun_volume = world_to_volume_;
}

void SunVolume::fill(ShaderLibrary& shaders, bool count_work, const DimmingMedia& media) {
    fill_light_volume(shaders, count_work, texture_, media, std::span(&rays_, 1));
    stale_ = false;
}

}  // namespace tyndall::volumetrics
