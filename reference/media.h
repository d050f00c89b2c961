#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/medium.h"
#include "reference/geometry.h"
#include "reference/media_shape.h"

namespace tyndall::reference {

/// What a medium is at a point.
struct MediumPoint {
    dvec3 sigma_s{0}, sigma_t{0};  ///< 1/m
    dvec3 emission{0};             ///< radiance per metre
    double anisotropy = 0;         ///< averaged by scattering (mean of the channels), that of air left out
    dvec3 air{0};                  ///< 1/m: the part of sigma_s that has Rayleigh's phase function
};

/// The media of a scene: overlapping ones add. Those that do nothing, whose size is not positive, and empty grids
/// are left out.
class Media {
  public:
    explicit Media(const std::vector<Medium>& media);
    [[nodiscard]] bool empty() const;
    [[nodiscard]] MediumPoint at(dvec3 point) const;

    /// Distances in (begin, end) along a ray where the media have an edge or a kink: rims, the inner end of soft
    /// rims, edges of a box's ramps. Sorted. Between two of them densities are smooth (noise apart).
    [[nodiscard]] std::vector<double> breakpoints(dvec3 origin, dvec3 unit_direction, double begin,
                                                  double end) const;

    /// Optical depth of [begin, end] of a ray; end may be infinite. Unbounded homogeneous media count when `global`
    /// is set: towards the sun they do not, as nothing says where sunlight would enter them. Closed where the
    /// density is constant or exponential, adaptive quadrature elsewhere, to `tolerance` absolute.
    [[nodiscard]] dvec3 optical_depth(dvec3 origin, dvec3 unit_direction, double begin, double end, bool global,
                                      const DepthTolerance& tolerance) const;

    /// An unbounded medium: homogeneous, or with a density of exp(-(y - base) / falloff).
    struct Unbounded {
        MediumPoint at_density_1;
        bool height;
        double base, falloff;
        [[nodiscard]] double density(double y) const { return height ? height_density(y, base, falloff) : 1; }
        [[nodiscard]] double density_length(double y, double rise, double length) const {
            return height ? height_length(y, rise, length, base, falloff) : length;
        }
    };
    [[nodiscard]] const std::vector<Unbounded>& unbounded() const { return unbounded_; }
    [[nodiscard]] const std::vector<MediumShape>& shapes() const { return shapes_; }
    [[nodiscard]] bool noisy() const;  ///< a shape has noise
    /// Of the unbounded media alone.
    [[nodiscard]] dvec3 unbounded_depth(double y, double rise, double length, bool global) const;
    /// Channels in which some medium scatters or emits.
    [[nodiscard]] glm::bvec3 channels() const;
    [[nodiscard]] bool has_air() const;  ///< a medium has Rayleigh's phase function

  private:
    std::vector<Unbounded> unbounded_;
    std::vector<MediumShape> shapes_;
};

/// Adds up media at a point.
class MediumSum {
  public:
    void add(const MediumPoint& at_density_1, double density);
    [[nodiscard]] MediumPoint result() const;

  private:
    MediumPoint sum_;
    double weight_ = 0;
};

}  // namespace tyndall::reference
