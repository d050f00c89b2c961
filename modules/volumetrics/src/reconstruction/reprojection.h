#pragma once

#include <glm/glm.hpp>

namespace tyndall::volumetrics {

/// Turn of the sun [rad] in one frame after which a mean over frames is worth one: it moves the shadow of something
/// 20 m away by 0.2 m, the size of a froxel at 25 m.
constexpr float sun_turn = 0.01F;

/// From view space to the clip space of the frame before. In double precision: far from the origin the two views
/// nearly cancel.
inline glm::mat4 previous_clip_from_view(const glm::mat4& previous_view, const glm::mat4& previous_projection,
                                         const glm::mat4& view) {
    return {glm::dmat4(previous_projection) * glm::dmat4(previous_view) * glm::inverse(glm::dmat4(view))};
}

}  // namespace tyndall::volumetrics
