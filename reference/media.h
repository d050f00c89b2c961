#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/medium.h"
#include "reference/geometry.h"

namespace tyndall::reference {

/// What a medium is at a point.
struct MediumPoint {
    dvec3 sigma_s{0}, sigma_t{0};  ///< 1/m
    dvec3 emission{0};             ///< radiance per metre
    double anisotropy = 0;         ///< averaged by scattering (mean of the channels)
};

/// The media of a scene: overlapping ones add.
class Media {
  public:
    explicit Media(const std::vector<Medium>& media);
    [[nodiscard]] bool empty() const;
    [[nodiscard]] MediumPoint at(dvec3 point) const;

    /// Distances in (begin, end) along a ray where the media have an edge or a kink: rims, the inner end of soft
    /// rims, edges of a box's ramps. Sorted. Between two of them densities are smooth (noise apart).
    [[nodiscard]] std::vector<double> breakpoints(dvec3 origin, dvec3 unit_direction, double begin, double end) const;

    /// Optical depth of [begin, end] of a ray; end may be infinite. Unbounded homogeneous media count when `global`
    /// is set: towards the sun they do not, as nothing says where sunlight would enter them. Closed where the density
    /// is constant or exponential, adaptive quadrature elsewhere, to `tolerance` absolute.
    [[nodiscard]] dvec3 optical_depth(dvec3 origin, dvec3 unit_direction, double begin, double end, bool global,
                                      double tolerance) const;

  private:
    std::vector<Medium> media_;
};

}  // namespace tyndall::reference
