#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace tyndall::grid_models {

/// A box of numbers that is sampled between them; outside lies the rim.
struct Field {
    glm::ivec3 size{0};
    std::vector<float> values;

    explicit Field(glm::ivec3 size_) : size(size_), values(std::size_t(size_.x) * size_.y * size_.z) {}
    [[nodiscard]] float& at(int x, int y, int z) { return values[(std::size_t(z) * size.y + y) * size.x + x]; }
    [[nodiscard]] float at(int x, int y, int z) const { return values[(std::size_t(z) * size.y + y) * size.x + x]; }
    /// Trilinear; numbers lie at whole coordinates. low and high: the least and greatest of the eight.
    [[nodiscard]] float sample(glm::vec3 p, float* low = nullptr, float* high = nullptr) const;
};

/// Air on a staggered grid (Harlow, Welch 1965), with a floor and open sides: semi-Lagrangian velocities (Stam
/// 1999), smoke and heat carried by MacCormack's scheme (Selle et al. 2008), vorticity confinement (Fedkiw et al.
/// 2001). One thread, in one order: the same numbers on every machine.
class Fluid {
  public:
    explicit Fluid(glm::ivec3 cells);

    Field smoke, heat;  ///< at the middles of cells

    /// Pushes the air: an acceleration, in cells and seconds, at the middle of a cell.
    void push(int x, int y, int z, const glm::vec3& by);
    /// lift: acceleration by one unit of heat; swirl: strength of the confinement.
    void step(float seconds, float lift, float swirl);

  private:
    [[nodiscard]] glm::vec3 velocity(glm::vec3 cell) const;
    void find_middles();
    void confine(float swirl);
    void apply_forces(float seconds, float lift);
    void carry_velocities(float seconds);
    void carry_contents(float seconds);
    void make_incompressible();

    glm::ivec3 cells_;
    Field velocity_[3];  ///< at the lower faces of cells
    Field middle_[3];    ///< velocity at the middles of cells
    Field force_[3];     ///< at the middles of cells
    Field pressure_;     ///< with a rim of one cell
};

}  // namespace tyndall::grid_models
