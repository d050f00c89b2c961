#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/scene/medium.h"
#include "reference/density_field.h"
#include "reference/geometry.h"
#include "reference/media_noise.h"

namespace tyndall::reference {

/// Integral of exp(min((base - y) / falloff, 60)) over `length` metres (may be infinite) of a line that starts at
/// height y and rises by `rise` per metre.
[[nodiscard]] double height_length(double y, double rise, double length, double base, double falloff);
[[nodiscard]] double height_density(double y, double base, double falloff);

/// How exact an integral of density or extinction must be. `smooth`: greatest error; `noise`: root mean square
/// error where a medium is noisy, which may be larger where many such integrals are averaged.
struct DepthTolerance {
    double smooth, noise;
    DepthTolerance(double both) : smooth(both), noise(both) {}
    DepthTolerance(double smooth_, double noise_) : smooth(smooth_), noise(noise_) {}
    [[nodiscard]] DepthTolerance over(double sigma_t) const { return {smooth / sigma_t, noise / sigma_t}; }
};

/// A bounded medium: its density is rim * noise * height profile, or that of a grid.
class MediumShape {
  public:
    explicit MediumShape(const Medium& medium);

    dvec3 sigma_s, sigma_t, emission;
    double anisotropy;

    /// A ray in the shape's frame, and the part of it that lies inside; for a grid, in its smallest box outside of
    /// which there is nothing.
    struct Path {
        const MediumShape* shape;
        dvec3 origin, direction;
        double height, rise;  ///< in the world
        Interval inside;      ///< distances, may be negative
        [[nodiscard]] double density(double t) const {
            return shape->density(origin + t * direction, height + t * rise);
        }
    };
    /// Nothing where the ray misses the shape.
    [[nodiscard]] std::optional<Path> path(dvec3 origin, dvec3 unit_direction) const;

    [[nodiscard]] double density(dvec3 world) const;
    [[nodiscard]] double greatest_density() const;  ///< an upper bound

    /// Kinks of the density along a path within [begin, end], its ends among them; rising. `features`: where there
    /// is noise, also points as far apart as its largest features, so that a quadrature rule cannot miss those.
    [[nodiscard]] std::vector<double> knots(const Path& path, double begin, double end, bool features) const;
    [[nodiscard]] bool noisy() const { return noisy_; }
    [[nodiscard]] bool is_grid() const { return field_ != nullptr; }
    /// Of a grid: along a path within [begin, end].
    [[nodiscard]] DensityLine line(const Path& path, double begin, double end) const;
    /// The integral of the density between two distances can be had in closed form.
    [[nodiscard]] bool closed() const { return !noisy_ && (softness_ == 0 || (box_ && !profile_)); }
    /// What an integral over `length` metres can be accurate to, m, if asked for `tolerance`: noise is single
    /// precision.
    [[nodiscard]] double attainable(double tolerance, double length) const;
    /// That integral, m: in closed form, by adaptive quadrature, or, for noise, by a rule of fixed spacing, which
    /// is smooth as path and limits move. Tolerances in m.
    [[nodiscard]] double density_length(const Path& path, double begin, double end,
                                        const DepthTolerance& tolerance) const;

  private:
    [[nodiscard]] double density(dvec3 local, double y) const;
    [[nodiscard]] double smooth_density(dvec3 local, double y) const;  ///< without noise
    [[nodiscard]] double depth(dvec3 local) const;
    [[nodiscard]] dvec3 to_local(dvec3 world) const { return world_to_shape_ * (world - center_); }
    [[nodiscard]] std::optional<Interval> slab_chord(dvec3 o, dvec3 d) const;
    [[nodiscard]] std::optional<Interval> ellipsoid_chord(dvec3 o, dvec3 d) const;
    [[nodiscard]] double noise_length(const Path& path, const std::vector<double>& knots, double tolerance) const;
    void add_box_knots(const Path& path, std::vector<double>& knots) const;
    void add_ellipsoid_knots(const Path& path, std::vector<double>& knots) const;

    void place_grid(const Medium& medium);

    std::shared_ptr<const DensityField> field_;  ///< of a grid, whose frame is voxel coordinates less the middle
    dvec3 field_middle_{0};
    double field_density_ = 0, field_greatest_ = 0;  ///< at a voxel of value 1, and anywhere
    bool box_;                                       ///< or the box round a grid
    dvec3 center_, extent_;                          ///< half size of a box, radii
    double bounding_radius_;
    glm::dmat3 world_to_shape_;
    double softness_;  ///< 0: the rim is a step
    bool noisy_, profile_;
    MediaNoise noise_;
    double base_, falloff_;
};

}  // namespace tyndall::reference
