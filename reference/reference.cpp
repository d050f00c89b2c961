#include "reference/reference.h"

#include "engine/core/error.h"

namespace tyndall::reference {
struct Reference::Impl {};
Reference::Reference(const Scene&, const Settings&) { throw Error("reference: not there yet"); }
Reference::~Reference() = default;
Reference::Ray Reference::trace(dvec3, dvec3, double) const { return {}; }
Picture render(const Reference&, const View&, glm::ivec2, int, int, const std::function<void(int, int)>&) { return {}; }
}  // namespace tyndall::reference
