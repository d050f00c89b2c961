#pragma once

#include <vector>

#include "reference/density_table.h"
#include "reference/media.h"

namespace tyndall::reference {

/// The media along one ray from the eye. What is varied by noise or has a curved soft rim is integrated once, into
/// a table, and so are grids, cell by cell; all else is in closed form.
class MediaRay {
  public:
    /// `end` may be infinite. `tolerance`: absolute, of optical depths.
    MediaRay(const Media& media, dvec3 origin, dvec3 unit_direction, double end, double tolerance);

    [[nodiscard]] MediumPoint at(double t) const;
    [[nodiscard]] dvec3 depth(double t) const;  ///< optical depth of [0, t]; t may be infinite
    /// Always finite: behind it nothing scatters or emits, or less than 1e-19 of what does comes through. Emission
    /// in a channel that nothing attenuates has no finite sum on an endless ray: it counts up to 1e9 m.
    [[nodiscard]] double end() const { return end_; }
    /// Rising, from 0 to end(): kinks of the media, and where transmittance or a height profile change by much.
    [[nodiscard]] const std::vector<double>& knots() const { return knots_; }
    [[nodiscard]] bool has_air() const { return media_->has_air(); }
    [[nodiscard]] bool noisy() const { return media_->noisy(); }
    /// Upper bound of the scattering coefficient along the ray.
    [[nodiscard]] dvec3 greatest_sigma_s() const;
    [[nodiscard]] double greatest_anisotropy() const;  ///< of |g|

  private:
    struct Local {
        MediumShape::Path path;
        DensityTable table{};                                 ///< empty where the shape's integral is closed
        DensityLine line{};                                   ///< of a grid
        [[nodiscard]] double density_length(double t) const;  ///< over [0, t], m
    };
    [[nodiscard]] double source_end(double end) const;
    [[nodiscard]] double where_depth_is(double depth, double end, bool thinnest) const;
    void find_knots();

    const Media* media_;
    dvec3 origin_, direction_;
    glm::bvec3 channels_;
    std::vector<Local> locals_;
    double end_ = 0;
    std::vector<double> knots_;
};

}  // namespace tyndall::reference
