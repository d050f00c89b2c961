#pragma once

#include "draw_scene.h"

namespace tyndall::stress {

/// What a technique takes into account.
struct Knows {
    bool local, lamps, shadow_maps;
};
[[nodiscard]] Knows knows(const std::string& technique);

/// Holds light in froxels, and their history.
[[nodiscard]] bool holds_froxels(const std::string& technique);

/// Comparable structures take turns, so that few frames meet every technique, with local media and with shadows.
constexpr int moderate_turns = 16;
/// Extinctions of 1e-4 to 0.3 /m (local: 0.01 to 0.15), |g| up to 0.6, near planes of 0.1 m, lamps within 25 m
/// whose range ends before the march does, 24 to 128 steps.
void moderate_structure(Structure& structure, int turn, Random& random);
/// That leaves no pixel without a particle, in the settings' unit.
constexpr float least_particle_size = 2;
/// Some visits of a structure are without local media, and for what samples those and lamps coarsely, without both.
void moderate_visit(Structure& structure, int visit);
/// The settings of one frame. Visits of a structure go through its features.
void moderate_frame(StressFrame& frame, int visit, Random& of_sequence, Random& random);

/// The same frame with nothing between samples and picture.
[[nodiscard]] StressOptions plain(StressOptions options);

}  // namespace tyndall::stress
