#include "support/walker.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace tyndall::test {

float ground_distance(glm::vec3 a, glm::vec3 b) {
    return std::hypot(a.x - b.x, a.z - b.z);
}

Input towards(const Player& player, glm::vec3 target) {
    const glm::vec3 way = target - player.eye();
    const float yaw = std::atan2(-player.direction().x, -player.direction().z);
    Input input;
    input.keys_down[static_cast<std::size_t>(Key::w)] = true;
    input.pointer_delta.x = -std::remainder(std::atan2(-way.x, -way.z) - yaw, glm::two_pi<float>()) / 0.0022;
    return input;
}

}  // namespace tyndall::test
