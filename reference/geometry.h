#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "engine/scene/scene.h"

namespace tyndall::reference {

using glm::dvec2;
using glm::dvec3;

/// A stretch [begin, end] of a ray, distances in metres.
struct Interval {
    double begin, end;
};

class Tint;

/// All triangles of a scene as posed now, in world space: what blocks the eye and what blocks light. Transparent
/// (alpha-blended) materials block neither, but tint light, see Tint; alpha-masked ones are cut out at their cutoff
/// by bilinear look-up in the full-resolution texture. Rays are Embree's; lit intervals are exact, see below. Safe
/// to use from many threads.
class Geometry {
  public:
    /// The scene must outlive this. `shadows` false: nothing blocks light.
    Geometry(const Scene& scene, bool shadows);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    struct Hit {
        double distance;         ///< m along the ray
        std::uint32_t triangle;  ///< index for Surface
        dvec2 barycentric;       ///< weights of the second and third corner
        bool front;              ///< glTF's: corners run counter-clockwise, or clockwise where the node mirrors
    };
    /// What the eye sees first beyond `begin` metres: back faces of one-sided materials are invisible.
    [[nodiscard]] std::optional<Hit> closest_hit(dvec3 origin, dvec3 unit_direction, double begin) const;

    /// Something that casts shadows lies between `from` and `from + distance * unit_direction` (distance may be
    /// infinite). Both sides block. Surfaces within `skip` metres of either end (exactly, along the ray) do not.
    [[nodiscard]] bool occluded(dvec3 from, dvec3 unit_direction, double distance, double skip) const;

    /// The parts of origin + t * unit_direction, t in [begin, end], from which a light is visible, in order and
    /// disjoint: by slicing every triangle with the plane through ray and light and projecting the cut onto the
    /// ray, so that no occluder is too thin to count and edges are exact to rounding; masks, too, as they are
    /// quadratic along the cut. Both sides block. `end` may be infinite. A ray within 1e-7 rad of the light's
    /// direction (or through the lamp) is lit up to the first surface from the light. Not counted: dark or lit
    /// stretches below 1e-9 m, and what, along the light, lies within 1e-9 m of the ray or 1e-6 m of the lamp (a
    /// ray along a floor, a lamp on a ceiling). There is no near plane: what is nearer to a lamp than its radius
    /// darkens it here, and not in the engine's shadow maps.
    [[nodiscard]] std::vector<Interval> lit_by_sun(dvec3 origin, dvec3 unit_direction, double begin, double end,
                                                   dvec3 to_sun) const;
    [[nodiscard]] std::vector<Interval> lit_by_lamp(dvec3 origin, dvec3 unit_direction, double begin, double end,
                                                    dvec3 lamp) const;

    /// What transparent surfaces leave of a light along a ray, with edges as exact as those of lit intervals; clear
    /// where nothing blocks light. A ray within 1e-7 rad of the light's direction (or through the lamp) is taken
    /// along the light.
    [[nodiscard]] Tint tint_by_sun(dvec3 origin, dvec3 unit_direction, double begin, double end,
                                   dvec3 to_sun) const;
    [[nodiscard]] Tint tint_by_lamp(dvec3 origin, dvec3 unit_direction, double begin, double end, dvec3 lamp) const;
    /// The same at one point, for a light at `distance` metres, or a sun where that is infinite. Surfaces within
    /// `skip` metres of the point do not count.
    [[nodiscard]] dvec3 tint(dvec3 from, dvec3 unit_direction, double distance, double skip) const;

    struct Impl;
    [[nodiscard]] const Impl& impl() const { return *impl_; }

  private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace tyndall::reference
