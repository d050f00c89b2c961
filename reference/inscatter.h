#pragma once

#include "reference/lights.h"
#include "reference/media_ray.h"
#include "reference/reference.h"

namespace tyndall::reference {

/// What shines into the media and onto the surfaces.
struct Lighting {
    std::vector<Sun> suns;
    std::vector<Lamp> lamps;
    dvec3 ambient{0};  ///< mean radiance of the sky over the sphere, cd/m²
};

/// In-scattered and emitted radiance along rays, by adaptive quadrature with one error budget for all lights of a
/// ray.
class InScattering {
  public:
    /// All must outlive this.
    InScattering(const Geometry& geometry, const Media& media, const Lighting& lighting, const Settings& settings);

    struct Result {
        dvec3 radiance{0};
        double error = 0;  ///< estimated, absolute, largest channel
    };
    [[nodiscard]] Result along(const MediaRay& ray, dvec3 origin, dvec3 unit_direction) const;

    /// Transmittance from a point towards the sun, and over `distance` metres towards a lamp.
    [[nodiscard]] dvec3 towards_sun(dvec3 point, dvec3 to_sun, const DepthTolerance& tolerance) const;
    [[nodiscard]] dvec3 towards_lamp(dvec3 point, dvec3 to_lamp, double distance,
                                     const DepthTolerance& tolerance) const;
    /// What a medium at a point sends of light from one direction into another, 1/(m sr).
    [[nodiscard]] dvec3 scattered(const MediumPoint& m, double cos_theta) const;
    /// What optical depths must be accurate to, absolute.
    [[nodiscard]] double depth_tolerance() const { return budget_depth * settings_.tolerance; }
    /// The same for paths to lights from the points of a ray: it averages many of them through noise, and
    /// neighbours half a feature apart are independent, so that of their error a quarter or less is left.
    [[nodiscard]] DepthTolerance averaged() const {
        return {depth_tolerance(), 4 * budget_noise * settings_.tolerance};
    }

  private:
    // How the tolerance is shared out. A depth counts twice: from the eye and from the light.
    static constexpr double budget_quadrature = 0.4, budget_left_out = 0.2, budget_depth = 0.05, budget_noise = 0.3;
    struct RaySum;
    const Geometry& geometry_;
    const Media& media_;
    const Lighting& lighting_;
    const Settings& settings_;
};

}  // namespace tyndall::reference
