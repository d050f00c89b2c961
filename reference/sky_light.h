#pragma once

#include "reference/inscatter.h"
#include "reference/surface.h"

namespace tyndall::reference {

/// Light of the sky through what the scene leaves open, scattered once by the air or reflected once by a surface:
///
///     L = ∫ T(0,t) σ_s(t) ∫ L_sky(w) V(t,w) T(t,w) p(w) dw dt
///
/// V is 0 behind what casts shadows, on both sides, and Tint behind transparent surfaces; T(t,w) is that towards a
/// sun. By points in t and w, drawn where sky, phase function and transmittance are great and where first points
/// saw the sky; scrambled by a hash of the ray (the surface), so that neighbours' errors differ.
class SkyLight {
  public:
    /// All must outlive this.
    SkyLight(const SkyTable& sky, const Geometry& geometry, const InScattering& scattering,
             const Settings& settings);

    /// In-scattered along a ray, times the factor `ambient`; error: the standard one, estimated.
    [[nodiscard]] InScattering::Result along(const MediaRay& ray, dvec3 origin, dvec3 unit_direction) const;
    /// Reflected by a surface, times the factor and the material's occlusion.
    [[nodiscard]] dvec3 reflected(const Surface& surface, dvec3 to_eye) const;

  private:
    [[nodiscard]] dvec3 diffuse(const Surface& surface, dvec3 to_eye) const;
    [[nodiscard]] dvec3 specular(const Surface& surface, dvec3 to_eye) const;
    /// What is left of the sky's light at a surface.
    [[nodiscard]] dvec3 reaching(const Surface& surface, dvec3 to_sky) const;

    const SkyTable& sky_;
    const Geometry& geometry_;
    const InScattering& scattering_;
    const Settings& settings_;
};

}  // namespace tyndall::reference
