#pragma once

#include <cstdint>
#include <vector>

#include "media/media.h"

namespace tyndall::volumetrics {

/// Particles of one dispatch of shaders/volumetrics/techniques/particles_simulate.comp: one level of the global
/// media, or one local medium. The members are its uniforms.
struct ParticleBatch {
    int medium = -1;  ///< index of the local medium; -1: the global ones
    std::uint32_t first = 0, count = 0;
    float radius = 0, volume = 0;  ///< m, m³ of each particle
    int side = 0;                  ///< cells of the level
    glm::ivec3 lower_cell{0};
    glm::vec3 lower_corner{0};    ///< m from the eye
    float spacing = 0;            ///< m
    glm::vec2 reach{0};           ///< m from the eye along the axes: of the level before, of this one
    float drift = 0;              ///< m, of a local medium's
    std::uint32_t placement = 0;  ///< another has its particles at other places
};

/// Global media: four levels of at most particle_count together, if there is a global medium. Local media:
/// particle_local_count by optical cross-section, at least 32 each. For a mean over frames each has its own, where
/// noise changes in time.
[[nodiscard]] std::vector<ParticleBatch> particle_batches(const Inputs& inputs, const Settings& settings,
                                                          const FrameMedia& media);
/// Where the global media's particles have half faded [m].
[[nodiscard]] float particle_reach(const Settings& settings);

}  // namespace tyndall::volumetrics
