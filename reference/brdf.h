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

    /// A light's direction, drawn where the specular lobe is, with specular * cosine over its density: a weight of
    /// at most 1, 0 where it lies below the horizon. By the microfacets that the eye sees; `u` and azimuth uniform
    /// in [0, 1) and over the circle.
    struct Sample {
        dvec3 to_light, weight;
    };
    [[nodiscard]] Sample sample(double u, double cos_azimuth, double sin_azimuth) const;

  private:
    [[nodiscard]] dvec3 fresnel(double v_dot_h) const;
    [[nodiscard]] double distribution(double n_dot_h) const;
    [[nodiscard]] double lambda(double cosine) const;
    [[nodiscard]] double visibility(double n_dot_l) const;

    dvec3 normal_, tangent_, bitangent_, to_eye_;
    double n_dot_v_, alpha2_;
    dvec3 f0_, albedo_;
    double f90_;
};

}  // namespace tyndall::reference
