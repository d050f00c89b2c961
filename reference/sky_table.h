#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace tyndall::reference {

using glm::dvec3;

/// Radiance over all directions, tabulated for quadrature: rows that crowd towards the horizon from above and from
/// below, since a sky has an edge there. Empty: black.
class SkyTable {
  public:
    SkyTable() = default;
    explicit SkyTable(const std::function<dvec3(dvec3 unit_direction)>& radiance);

    /// Bilinear, with the edge at the horizon kept.
    [[nodiscard]] dvec3 at(dvec3 unit_direction) const;
    /// Over the sphere.
    [[nodiscard]] dvec3 mean() const;

    /// A part of the sphere small enough for smooth lobes.
    struct Patch {
        dvec3 direction;  ///< unit, the middle
        dvec3 flux;       ///< integral of the radiance over its solid angle
    };
    [[nodiscard]] const std::vector<Patch>& patches() const { return patches_; }

  private:
    friend class SkySampler;
    std::vector<dvec3>
        cells_;  ///< [below, above the horizon][row from the horizon][azimuth], radiance at the middle
    std::vector<Patch> patches_;
};

/// Directions drawn in proportion to a table's radiance (the sum of its channels) times a lobe.
class SkySampler {
  public:
    /// `lobe` is positive, and taken in the middle of each of the table's cells. The table must outlive this.
    SkySampler(const SkyTable& table, const std::function<double(dvec3 unit_direction)>& lobe);

    struct Sample {
        dvec3 direction;
        dvec3 weight;  ///< the table's radiance over the density of drawing the direction, cd/m² sr
    };
    /// `u`, `v` uniform in [0, 1).
    [[nodiscard]] Sample at(double u, double v) const;

  private:
    const SkyTable* table_;
    std::vector<double> in_row_;  ///< of each cell: the sum over its row up to it
    std::vector<double> rows_;    ///< the sum of the rows up to each
};

}  // namespace tyndall::reference
