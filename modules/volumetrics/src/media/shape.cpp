#include "media/shape.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/error.h"
#include "media/shape_box.h"
#include "media/shape_ellipsoid.h"

namespace tyndall::volumetrics {
namespace {

/// The shapes, a row each.
template <class Question>
auto ask(Shape shape, Question question) {
    switch (shape) {
        case Shape::ellipsoid:
            return question(EllipsoidShape());
        case Shape::box:
        case Shape::grid:
            return question(BoxShape());
    }
    throw Error(fmt::format("volumetrics: shape {} of a local medium, one of Shape expected", int(shape)));
}

Shape shape_of(const shared::LocalMedium& medium) {
    return static_cast<Shape>(medium.sigma_a_shape.w);
}

}  // namespace

bool is_empty(const LocalMedium& medium) {
    return !glm::all(glm::greaterThan(medium.half_extent, glm::vec3(0)));
}

std::array<glm::vec3, 8> corners(const LocalMedium& medium) {
    const glm::mat3 rotation = glm::mat3_cast(medium.rotation);
    std::array<glm::vec3, 8> all;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 side{(corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1};
        all[static_cast<std::size_t>(corner)] = medium.center + rotation * (side * medium.half_extent);
    }
    return all;
}

glm::vec2 distances(const LocalMedium& medium, glm::vec3 point) {
    const glm::vec3 p = glm::abs(glm::conjugate(medium.rotation) * (point - medium.center));
    return {glm::length(glm::max(p - medium.half_extent, 0.0F)), glm::length(p + medium.half_extent)};
}

float bounding_radius(const LocalMedium& medium) {
    return ask(medium.shape, [&](auto shape) { return shape.bounding_radius(medium.half_extent); });
}

double half_extent_along(const LocalMedium& medium, glm::dvec3 direction) {
    const glm::dmat3 rotation = glm::mat3_cast(glm::dquat(medium.rotation));
    return ask(medium.shape, [&](auto shape) {
        return shape.half_extent_along(glm::dvec3(medium.half_extent), direction * rotation);
    });
}

shared::LocalMedium pack_shape(const LocalMedium& medium) {
    shared::LocalMedium packed{};
    const glm::mat4 rotation = glm::mat4_cast(glm::conjugate(medium.rotation));
    packed.world_to_shape = glm::translate(rotation, -medium.center);
    packed.extent_softness = {medium.half_extent, medium.softness};
    packed.sigma_a_shape.w = static_cast<float>(medium.shape);
    return packed;
}

float half_extent_along(const shared::LocalMedium& medium, glm::vec3 direction) {
    return ask(shape_of(medium), [&](auto shape) {
        return shape.half_extent_along(glm::vec3(medium.extent_softness),
                                       glm::mat3(medium.world_to_shape) * direction);
    });
}

float volume(const shared::LocalMedium& medium) {
    return ask(shape_of(medium), [&](auto shape) { return shape.volume(glm::vec3(medium.extent_softness)); });
}

}  // namespace tyndall::volumetrics
