#include "reference/geometry.h"

#include "engine/core/error.h"

namespace tyndall::reference {
struct Geometry::Impl {};
Geometry::Geometry(const Scene&, bool) { throw Error("reference: not there yet"); }
Geometry::~Geometry() = default;
std::optional<Geometry::Hit> Geometry::closest_hit(dvec3, dvec3, double) const { return {}; }
bool Geometry::occluded(dvec3, dvec3, double, double) const { return false; }
std::vector<Interval> Geometry::lit_by_sun(dvec3, dvec3, double, double, dvec3) const { return {}; }
std::vector<Interval> Geometry::lit_by_lamp(dvec3, dvec3, double, double, dvec3) const { return {}; }
}  // namespace tyndall::reference
