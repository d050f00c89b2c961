#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "reference/geometry.h"

namespace tyndall::reference {

/// What casts shadows, to the slicer.
struct Caster {
    std::array<dvec3, 3> corner;
    std::uint32_t triangle;  ///< of Geometry::Impl::triangles or glass
    std::array<dvec2, 3> uv;
    dvec3 alpha;           ///< of the corners' colours
    const Material* mask;  ///< null: opaque
};

/// gradient · (p - base) + constant.
struct Affine {
    dvec3 base{0}, gradient{0};
    double constant = 0;
    double operator()(dvec3 p) const { return glm::dot(gradient, p - base) + constant; }
};

/// The plane through a ray and a light. A point p of it on the light's side of the ray (above >= 0) darkens the ray
/// at t = numerator(p) / denominator(p); denominators below `nearest` lie at the light or behind it.
struct Slice {
    Affine plane, above, numerator, denominator;
    double nearest;
    double begin, end;
};
/// Empty where ray and light span no plane: within 1e-7 rad of the light's direction.
[[nodiscard]] std::optional<Slice> sun_slice(dvec3 origin, dvec3 unit_direction, double begin, double end,
                                             dvec3 to_sun);
[[nodiscard]] std::optional<Slice> lamp_slice(dvec3 origin, dvec3 unit_direction, double begin, double end,
                                              dvec3 lamp);

/// The straight line along which a slice cuts a triangle, by u from 0 to 1, in which the slice's functions are
/// linear.
struct Shadow {
    Interval part;  ///< of u: what lies between the light and the slice's stretch of the ray
    std::array<double, 2> numerator, denominator;
    std::array<dvec3, 2> weights;  ///< of the triangle's corners

    /// The distance along the ray that u darkens, and what of the ray a stretch of u does.
    [[nodiscard]] double ray_at(double u) const;
    [[nodiscard]] Interval on_ray(Interval stretch, const Slice& slice) const;
    /// Of the triangle's corners, at the point that darkens the ray at t.
    [[nodiscard]] dvec3 weights_at(double t) const;
};
[[nodiscard]] std::optional<Shadow> cut(const Caster& caster, const Slice& slice);

/// Sorts, and joins what overlaps or lies within a nanometre.
void merge(std::vector<Interval>& intervals);

/// Shadow casters in a hierarchy of boxes that planes are cut through. Thread-safe.
class SliceTree {
  public:
    /// The scene must outlive this.
    SliceTree(const Scene& scene, std::vector<Caster> casters, dvec3 center);

    /// What of [begin, end] is dark: sorted and disjoint.
    [[nodiscard]] std::vector<Interval> dark(const Slice& slice) const;

    struct Cut {
        std::uint32_t triangle;  ///< as Caster says
        Shadow shadow;
    };
    /// All casters between the light and [begin, end], in no order.
    [[nodiscard]] std::vector<Cut> cuts(const Slice& slice) const;

  private:
    /// Four boxes, tested together; single precision around `center_`, rounded outwards. An unused one is empty.
    struct Node {
        float center[3][4], extent[3][4];
        std::int32_t child[4];  ///< of a leaf: the first of its casters
        std::int32_t count[4];  ///< casters of a leaf; 0: `child` is a node
    };
    friend struct SliceTreeBuild;

    /// Calls `leaf` with every caster that the slice may cut.
    template <class Visit>
    void visit(const Slice& slice, Visit leaf) const;

    const Scene& scene_;
    std::vector<Caster> casters_;
    std::vector<Node> nodes_;  ///< the root is the last
    dvec3 center_;
};

/// The complement of sorted disjoint `dark` within [begin, end].
[[nodiscard]] std::vector<Interval> lit_between(const std::vector<Interval>& dark, double begin, double end);

}  // namespace tyndall::reference
