#pragma once

#include <glm/glm.hpp>

#include "reference/geometry.h"
#include "reference/sky_table.h"

namespace tyndall::reference {

/// A point of a surface with its glTF metallic-roughness material (textures bilinear, full resolution).
struct Surface {
    dvec3 position;
    dvec3 geometric_normal, normal;  ///< unit, on the side that is seen; `normal` with the normal map
    dvec3 base_color;
    double metallic, roughness, occlusion;
    double dielectric_f0;  ///< reflectance at normal incidence where not metal
    dvec3 emissive;        ///< cd/m²
};
[[nodiscard]] Surface surface_at(const Scene& scene, const Geometry& geometry, const Geometry::Hit& hit,
                                 dvec3 origin, dvec3 unit_direction);

/// BRDF times cosine [1/sr]: reflected radiance per unit of illuminance on a plane that faces the light. glTF 2.0
/// appendix B (GGX, height-correlated Smith, Schlick), written on its own: shares nothing with the shaders. Unit
/// directions away from the surface; 0 where the light is below the horizon.
[[nodiscard]] dvec3 reflected(const Surface& surface, dvec3 to_eye, dvec3 to_light);

/// What is left of a light `distance` metres away (or infinitely far) after what lies between it and a surface: 0
/// behind what blocks it, a colour behind glass.
[[nodiscard]] dvec3 visible(const Geometry& geometry, const Surface& surface, dvec3 to_light, double distance);

/// The sky as a light source, for the scene's sun: clear sky with clouds and disc as the engine draws it.
/// The model of the sky is part of the scene's description and is the shaders'; what is integrated over it is not.
class Sky {
  public:
    /// That of the brightest sun; night without one. `factor` multiplies what it sends to media and surfaces, not
    /// what is seen.
    Sky(const Scene& scene, double factor);
    [[nodiscard]] dvec3 background(dvec3 unit_direction) const;  ///< seen behind the scene, cd/m²
    [[nodiscard]] dvec3 mean_radiance() const;  ///< over the sphere, without the disc, times factor
    /// What a surface reflects of it, without occlusion by the scene: the integral of sky, BRDF and cosine times
    /// the material's occlusion and the factor.
    [[nodiscard]] dvec3 reflected(const Surface& surface, dvec3 to_eye) const;
    [[nodiscard]] const SkyTable& table() const { return table_; }  ///< empty where the factor is 0

  private:
    SkyTable table_;  ///< without clouds and disc
    dvec3 to_sun_{0, 1, 0};
    dvec3 illuminance_{0};
    double factor_;
    bool cirrus_;      ///< the sky paints high clouds: the scene has none
    float brightest_;  ///< cd/m²
};

}  // namespace tyndall::reference
