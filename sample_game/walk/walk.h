#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sample_game/walk/walk_script.h"

namespace tyndall {

/// What is played of a walk: which lamps burn, what is said, when it ends. Places are lit in any order; nothing is
/// ever lost again. It knows neither scene nor screen.
class Walk {
  public:
    /// What a player does in a frame.
    struct Player {
        glm::vec3 eye{0};
        glm::vec3 direction{0, 0, -1};
        bool use = false, lantern = false;  ///< pressed
    };
    /// `script` outlives it.
    explicit Walk(const WalkScript& script);
    void update(const Player& player, double dt);

    [[nodiscard]] bool lantern() const { return lantern_; }
    /// Seconds since a place was lit; nothing: it is dark.
    [[nodiscard]] std::optional<double> burning(std::size_t place) const { return burning_.at(place); }
    [[nodiscard]] std::size_t lit() const;
    /// 0 at first, 1 when all places are lit and the light has had time to follow.
    [[nodiscard]] float evening() const;
    /// The player has been without light for long: lamps that are to be lit show themselves.
    [[nodiscard]] bool is_lost() const;
    /// The last picture: it follows when all is lit and said. After it, nothing is left.
    [[nodiscard]] bool ending() const { return ending_.has_value(); }
    [[nodiscard]] bool over() const { return over_; }

    [[nodiscard]] std::string words() const;   ///< of the story; may be empty
    [[nodiscard]] std::string prompt() const;  ///< what can be done here, or where to go; may be empty

  private:
    [[nodiscard]] std::optional<std::size_t> dark_place_here() const;
    [[nodiscard]] std::string hint() const;

    const WalkScript* script_;
    Player player_;
    std::vector<std::optional<double>> burning_;
    bool lantern_ = false, has_used_lantern_ = false, over_ = false;
    double time_ = 0, since_lit_ = 0;  ///< s; since the beginning, where none was lit
    std::optional<std::size_t> last_lit_;
    std::optional<double> ending_;  ///< s
};

/// 0 below 0, 1 above 1, between them with a soft begin and end.
[[nodiscard]] float smooth_share(double x);
/// "ahead", "to the right", … of someone who looks along `direction`.
[[nodiscard]] std::string direction_words(glm::vec3 direction, glm::vec3 way);

}  // namespace tyndall
