#pragma once

#include "sample_game/player.h"

namespace tyndall::test {

[[nodiscard]] float ground_distance(glm::vec3 a, glm::vec3 b);
/// What somebody presses who walks towards a point: turns to it at once, by the pointer.
[[nodiscard]] Input towards(const Player& player, glm::vec3 target);

}  // namespace tyndall::test
