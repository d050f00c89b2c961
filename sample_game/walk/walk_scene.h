#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/scene/scene.h"
#include "sample_game/walk/walk.h"

namespace tyndall {

/// The light of a walk in its level: lamps that are dark or burn, what glows in them, the player's lantern, fog,
/// and the sun that goes down.
class WalkScene {
  public:
    /// Adds the lantern, and for each glowing thing at a lamp one that glows and a dark one in its place, before
    /// the renderer takes the scene. What glows casts no shadow (assets/levels/README.md). Throws Error, which
    /// begins with `where`: the script names what the scene has not.
    WalkScene(WalkScript script, Scene& scene, const std::string& where);

    [[nodiscard]] const WalkScript& script() const { return script_; }
    /// The scene as the walk has it. `eye_to_world`: the player's.
    void apply(Scene& scene, const Walk& walk, const glm::mat4& eye_to_world, double time) const;
    /// The scene as the level has it.
    void restore(Scene& scene) const;

  private:
    struct Lamp {
        std::size_t light;
        glm::vec3 intensity;
        std::size_t place;
        float delay;                     ///< s after its place is lit
        bool first = false;              ///< that which the player lights
        std::vector<int> glowing, dark;  ///< nodes, of which one kind shows: the other has no size
    };
    struct Sun {
        std::size_t light;
        glm::vec3 intensity;
    };
    void gather_lamps(const Scene& scene, const std::string& where);
    void add_twins(Scene& scene);
    [[nodiscard]] Lamp* lamp_at(const Scene& scene, glm::vec3 middle);
    static void shine(Scene& scene, const Lamp& lamp, float brightness, bool glows);

    WalkScript script_;
    std::vector<Lamp> lamps_;
    std::vector<Medium> media_;
    std::optional<Sun> sun_;
    float exposure_;
    std::size_t lantern_ = 0;  ///< of the scene's lights
};

}  // namespace tyndall
