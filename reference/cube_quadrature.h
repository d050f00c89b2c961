#pragma once

#include <functional>
#include <glm/glm.hpp>

namespace tyndall::reference {

struct CubeIntegral {
    glm::dvec3 value{0}, error{0};  ///< error: the standard one, estimated from parts of the points
};

/// The integral over the unit cube of a function that is about even, and 0 where something hides it: by `samples`
/// (256 or more) low-discrepancy points, more where first points, a quarter as many, found it great, in a grid of
/// `layers` (x) by 16 by 24 cells. Along z the ends of the cube meet. `seed` scrambles the points.
[[nodiscard]] CubeIntegral integrate_cube(const std::function<glm::dvec3(glm::dvec3)>& f, std::size_t layers,
                                          int samples, glm::dvec3 seed);

}  // namespace tyndall::reference
