#pragma once

#include "reference/surface.h"

namespace tyndall::reference {

/// The lobes of a surface for one direction of the eye, 1/sr, without the cosine. Unit directions away from the
/// surface.
class Brdf {
  public:
    Brdf(const Surface& surface, dvec3 to_eye);
    [[nodiscard]] dvec3 diffuse(dvec3 to_light) const;
    [[nodiscard]] dvec3 specular(dvec3 to_light) const;

    /// The half vector at which a fraction u in [0, 1) of the microfacets' projected area lies nearer to the
    /// normal, at an azimuth given by its cosine and sine.
    [[nodiscard]] dvec3 half_vector(double u, double cos_azimuth, double sin_azimuth) const;
    /// specular * cosine over the density of the light's direction, if `half_vector` is drawn with u and azimuth
    /// uniform; 0 where the mirrored direction lies below the horizon.
    [[nodiscard]] dvec3 specular_weight(dvec3 half_vector, dvec3 to_light) const;

  private:
    [[nodiscard]] dvec3 fresnel(double v_dot_h) const;
    [[nodiscard]] double distribution(double n_dot_h) const;
    [[nodiscard]] double visibility(double n_dot_l) const;

    dvec3 normal_, tangent_, bitangent_, to_eye_;
    double n_dot_v_, alpha2_;
    dvec3 f0_, albedo_;
    double f90_;
};

}  // namespace tyndall::reference
