#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "engine/platform/input.h"
#include "engine/scene/scene.h"
#include "sample_game/key_bindings.h"

namespace tyndall {

/// First-person walker in a level: a capsule (Bullet's kinematic character) against the level's solid triangles, or
/// a free camera in fly mode. Metres, seconds, radians.
class Player {
  public:
    /// Collision is every mesh that is neither alpha-masked (leaves) nor blended nor animated.
    explicit Player(const Scene& scene);
    ~Player();

    /// Puts the eye at `eye`, looking along `direction`, at rest.
    void place(glm::vec3 eye, glm::vec3 direction);
    /// To where the level puts a player at first, on foot where it says so.
    void restart();
    float look_speed = 1;      ///< of pointer, stick and arrow keys
    bool invert_look = false;  ///< down looks up
    KeyBindings keys;

    /// Turns, walks or flies for `dt` seconds in equal steps of at most 1/120 s, so that slow frames lead where
    /// fast ones do. `look` says whether the pointer turns the view. True (a camera cut): the player fell out of
    /// the level and stands at the start again, or walked out of it, onto the node `terrain`, and stands a few
    /// metres back.
    bool update(const Input& input, double dt, bool look);

    [[nodiscard]] glm::vec3 eye() const { return eye_; }
    [[nodiscard]] glm::vec3 direction() const;
    [[nodiscard]] glm::mat4 camera_to_world() const;
    [[nodiscard]] bool flying() const { return flying_; }
    void set_flying(bool flying);
    [[nodiscard]] bool on_ground() const;

  private:
    void turn(glm::vec2 angles);
    bool strayed();
    void fly_step(const Input& input, glm::vec2 move, float dt);
    void walk_step(const Input& input, glm::vec2 move, float dt);

    struct World;
    std::unique_ptr<World> world_;
    glm::vec3 eye_{0};
    glm::vec3 start_{0};
    glm::vec3 start_direction_{0, 0, -1};
    bool starts_flying_ = false;
    float yaw_ = 0, pitch_ = 0;
    float stair_offset_ = 0;  ///< m the eye lags behind the capsule, so that stairs are a ramp to it
    float last_drop_ = 0;  ///< m fallen in the last physics step; the controller drops more than that as it lands
    float lowest_ = 0;     ///< below this the player has fallen out of the level
    bool flying_ = false;
    std::vector<glm::vec3> way_;  ///< where he lately walked in the level, the older one first; or nothing
};

}  // namespace tyndall
