#include "reference/geometry.h"

#include <algorithm>

#include "reference/geometry_impl.h"
#include "reference/tint.h"

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Stands for infinity where numbers must be finite; m.
constexpr double very_far = 1e9;

/// What of [begin, end] lies in [from, to].
std::vector<Interval> clipped(double begin, double end, double from, double to) {
    const Interval lit{std::max(begin, from), std::min(end, to)};
    if (lit.begin >= lit.end) return {};
    return {lit};
}

std::vector<Interval> lit_of_slice(const SliceTree& casters, const Slice& slice, double end) {
    std::vector<Interval> lit = lit_between(casters.dark(slice), slice.begin, slice.end);
    if (!lit.empty() && lit.back().end == slice.end) lit.back().end = end;
    return lit;
}

Tint tint_of_slice(const Geometry::Impl& geometry, const Slice& slice) {
    Tint tint(geometry);
    for (const auto& [triangle, shadow] : geometry.panes->cuts(slice)) {
        Interval part = shadow.on_ray(shadow.part, slice);
        if (part.end == slice.end) part.end = infinity;
        tint.add({part, triangle, shadow});
    }
    return tint;
}

/// Adds what a ray along the light crosses within `distance` metres of `from`, its end away from the light;
/// `tinted(d)` is what of the ray lies behind a pane d metres from `from`.
template <class Tinted>
void add_along(const Geometry::Impl& geometry, dvec3 from, dvec3 to_light, double distance, Tinted tinted,
               Tint& tint) {
    for (const auto& [triangle, weights, d] : geometry.glass_between(from, to_light, distance))
        tint.add({tinted(d), triangle, {{0, 1}, {0, 0}, {1, 1}, {weights, weights}}});
}

}  // namespace

Geometry::Geometry(const Scene& scene, bool shadows) : impl_(std::make_unique<Impl>(scene, shadows)) {}
Geometry::~Geometry() = default;

std::optional<Geometry::Hit> Geometry::closest_hit(dvec3 origin, dvec3 unit_direction, double begin) const {
    return impl_->first_hit(origin, unit_direction, begin, infinity, Impl::Sees::eye);
}

bool Geometry::occluded(dvec3 from, dvec3 unit_direction, double distance, double skip) const {
    return impl_->shadows && impl_->any_hit(from, unit_direction, skip, distance - skip);
}

std::vector<Interval> Geometry::lit_by_sun(dvec3 origin, dvec3 unit_direction, double begin, double end,
                                           dvec3 to_sun) const {
    if (begin >= end) return {};
    if (!impl_->shadows) return {{begin, end}};
    if (const auto slice = sun_slice(origin, unit_direction, begin, std::min(end, begin + very_far), to_sun))
        return lit_of_slice(*impl_->casters, *slice, end);
    // Along the light: the first surface that it meets ends it.
    const double start = impl_->beyond(origin);
    const auto hit = impl_->first_hit(origin + start * to_sun, -to_sun, 0, infinity, Impl::Sees::light);
    if (!hit) return {{begin, end}};
    const double height = start - hit->distance;  // along to_sun, from the ray's origin
    return glm::dot(unit_direction, to_sun) > 0 ? clipped(begin, end, height, infinity)
                                                : clipped(begin, end, -infinity, -height);
}

std::vector<Interval> Geometry::lit_by_lamp(dvec3 origin, dvec3 unit_direction, double begin, double end,
                                            dvec3 lamp) const {
    if (begin >= end) return {};
    if (!impl_->shadows) return {{begin, end}};
    if (const auto slice = lamp_slice(origin, unit_direction, begin, std::min(end, begin + very_far), lamp))
        return lit_of_slice(*impl_->casters, *slice, end);
    // Through the lamp: lit from it to the first surface either way.
    constexpr double at_lamp = 1e-6;
    const double t = glm::dot(lamp - origin, unit_direction);
    const auto ahead = impl_->first_hit(lamp, unit_direction, at_lamp, infinity, Impl::Sees::light);
    const auto back = impl_->first_hit(lamp, -unit_direction, at_lamp, infinity, Impl::Sees::light);
    return clipped(begin, end, back ? t - back->distance : -infinity, ahead ? t + ahead->distance : infinity);
}

Tint Geometry::tint_by_sun(dvec3 origin, dvec3 unit_direction, double begin, double end, dvec3 to_sun) const {
    if (begin >= end || !impl_->panes) return {};
    if (const auto slice = sun_slice(origin, unit_direction, begin, std::min(end, begin + very_far), to_sun))
        return tint_of_slice(*impl_, *slice);
    const bool upwards = glm::dot(unit_direction, to_sun) > 0;
    const double start = impl_->beyond(origin);
    Tint tint(*impl_);
    add_along(
        *impl_, origin - start * to_sun, to_sun, infinity,
        [&](double d) {
            return upwards ? Interval{-infinity, d - start} : Interval{start - d, infinity};
        },
        tint);
    return tint;
}

Tint Geometry::tint_by_lamp(dvec3 origin, dvec3 unit_direction, double begin, double end, dvec3 lamp) const {
    if (begin >= end || !impl_->panes) return {};
    if (const auto slice = lamp_slice(origin, unit_direction, begin, std::min(end, begin + very_far), lamp))
        return tint_of_slice(*impl_, *slice);
    const double t = glm::dot(lamp - origin, unit_direction), start = impl_->beyond(lamp);
    Tint tint(*impl_);
    add_along(
        *impl_, lamp + start * unit_direction, -unit_direction, start,
        [&](double d) {
            return Interval{t + start - d, infinity};
        },
        tint);
    add_along(
        *impl_, lamp - start * unit_direction, unit_direction, start,
        [&](double d) {
            return Interval{-infinity, t - start + d};
        },
        tint);
    return tint;
}

dvec3 Geometry::tint(dvec3 from, dvec3 unit_direction, double distance, double skip) const {
    dvec3 product(1);
    for (const auto& pane : impl_->glass_between(from + skip * unit_direction, unit_direction, distance - skip))
        product *= impl_->filter(impl_->glass[pane.triangle], pane.weights);
    return product;
}

}  // namespace tyndall::reference
