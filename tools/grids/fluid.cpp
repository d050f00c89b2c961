#include "tools/grids/fluid.h"

#include <algorithm>
#include <cmath>

namespace tyndall::grid_models {
namespace {

constexpr glm::ivec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

template <class Visit>
void for_each(const glm::ivec3& low, const glm::ivec3& high, Visit visit) {
    for (int z = low.z; z < high.z; ++z)
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x) visit(x, y, z);
}

}  // namespace

float Field::sample(glm::vec3 p, float* low, float* high) const {
    p = glm::clamp(p, glm::vec3(0), glm::vec3(size - 1));
    const glm::ivec3 a = glm::min(glm::ivec3(p), glm::max(size - 2, 0)), b = glm::min(a + 1, size - 1);
    const glm::vec3 f = p - glm::vec3(a);
    const float v[8] = {at(a.x, a.y, a.z), at(b.x, a.y, a.z), at(a.x, b.y, a.z), at(b.x, b.y, a.z),
                        at(a.x, a.y, b.z), at(b.x, a.y, b.z), at(a.x, b.y, b.z), at(b.x, b.y, b.z)};
    if (low != nullptr) *low = *std::min_element(v, v + 8);
    if (high != nullptr) *high = *std::max_element(v, v + 8);
    const auto mix = [](float from, float to, float share) { return from + (to - from) * share; };
    return mix(mix(mix(v[0], v[1], f.x), mix(v[2], v[3], f.x), f.y),
               mix(mix(v[4], v[5], f.x), mix(v[6], v[7], f.x), f.y), f.z);
}

Fluid::Fluid(glm::ivec3 cells)
    : smoke(cells),
      heat(cells),
      cells_(cells),
      velocity_{Field(cells + unit[0]), Field(cells + unit[1]), Field(cells + unit[2])},
      middle_{Field(cells), Field(cells), Field(cells)},
      force_{Field(cells), Field(cells), Field(cells)},
      pressure_(cells + 2) {}

void Fluid::push(int x, int y, int z, const glm::vec3& by) {
    for (int axis = 0; axis < 3; ++axis) force_[axis].at(x, y, z) += by[axis];
}

glm::vec3 Fluid::velocity(glm::vec3 cell) const {
    return {middle_[0].sample(cell), middle_[1].sample(cell), middle_[2].sample(cell)};
}

void Fluid::find_middles() {
    for (int axis = 0; axis < 3; ++axis) {
        const glm::ivec3 step = unit[axis];
        for_each(glm::ivec3(0), cells_, [&](int x, int y, int z) {
            middle_[axis].at(x, y, z) =
                0.5F * (velocity_[axis].at(x, y, z) + velocity_[axis].at(x + step.x, y + step.y, z + step.z));
        });
    }
}

void Fluid::confine(float swirl) {
    Field curl[3] = {Field(cells_), Field(cells_), Field(cells_)}, strength(cells_);
    for_each(glm::ivec3(1), cells_ - 1, [&](int x, int y, int z) {
        const auto slope = [&](int of, int along) {
            const glm::ivec3 step = unit[along];
            return 0.5F * (middle_[of].at(x + step.x, y + step.y, z + step.z) -
                           middle_[of].at(x - step.x, y - step.y, z - step.z));
        };
        const glm::vec3 w(slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1));
        for (int axis = 0; axis < 3; ++axis) curl[axis].at(x, y, z) = w[axis];
        strength.at(x, y, z) = std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
    });
    for_each(glm::ivec3(2), cells_ - 2, [&](int x, int y, int z) {
        const glm::vec3 gradient(strength.at(x + 1, y, z) - strength.at(x - 1, y, z),
                                 strength.at(x, y + 1, z) - strength.at(x, y - 1, z),
                                 strength.at(x, y, z + 1) - strength.at(x, y, z - 1));
        const float length = std::sqrt(gradient.x * gradient.x + gradient.y * gradient.y + gradient.z * gradient.z);
        if (length < 1e-5F) return;
        const glm::vec3 towards = gradient / length;
        const glm::vec3 w(curl[0].at(x, y, z), curl[1].at(x, y, z), curl[2].at(x, y, z));
        push(x, y, z,
             swirl * glm::vec3(towards.y * w.z - towards.z * w.y, towards.z * w.x - towards.x * w.z,
                               towards.x * w.y - towards.y * w.x));
    });
}

void Fluid::apply_forces(float seconds, float lift) {
    for_each(glm::ivec3(0), cells_, [&](int x, int y, int z) { force_[1].at(x, y, z) += lift * heat.at(x, y, z); });
    for (int axis = 0; axis < 3; ++axis) {
        const glm::ivec3 step = unit[axis];
        for_each(step, cells_, [&](int x, int y, int z) {
            velocity_[axis].at(x, y, z) +=
                0.5F * seconds * (force_[axis].at(x, y, z) + force_[axis].at(x - step.x, y - step.y, z - step.z));
        });
        std::ranges::fill(force_[axis].values, 0.0F);
    }
}

void Fluid::carry_velocities(float seconds) {
    Field carried[3] = {velocity_[0], velocity_[1], velocity_[2]};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3 offset = -0.5F * glm::vec3(unit[axis]);  // of a face from the middle of its cell
        for_each(glm::ivec3(0), velocity_[axis].size, [&](int x, int y, int z) {
            const glm::vec3 face(x, y, z);
            carried[axis].at(x, y, z) = velocity_[axis].sample(face - seconds * velocity(face + offset));
        });
    }
    for (int axis = 0; axis < 3; ++axis) velocity_[axis] = std::move(carried[axis]);
}

void Fluid::carry_contents(float seconds) {
    Field* const contents[2] = {&smoke, &heat};
    std::vector<glm::vec3> from(smoke.values.size()), to(smoke.values.size());
    std::size_t i = 0;
    for_each(glm::ivec3(0), cells_, [&](int x, int y, int z) {
        const glm::vec3 cell(x, y, z);
        const glm::vec3 v(middle_[0].at(x, y, z), middle_[1].at(x, y, z), middle_[2].at(x, y, z));
        from[i] = cell - seconds * velocity(cell - 0.5F * seconds * v);  // Runge and Kutta's second order
        to[i] = cell + seconds * velocity(cell + 0.5F * seconds * v);
        ++i;
    });
    for (Field* content : contents) {
        Field forward(cells_), result(cells_);
        for (std::size_t n = 0; n < from.size(); ++n) forward.values[n] = content->sample(from[n]);
        for (std::size_t n = 0; n < from.size(); ++n) {
            float low = 0, high = 0;
            (void)content->sample(from[n], &low, &high);
            const float back = forward.sample(to[n]);
            result.values[n] = std::clamp(forward.values[n] + 0.5F * (content->values[n] - back), low, high);
        }
        *content = std::move(result);
    }
}

/// Successive over-relaxation; no pressure beyond the open sides, none through the floor.
void Fluid::make_incompressible() {
    constexpr int sweeps = 24;
    constexpr float relaxation = 1.8F;
    for_each({0, 0, 0}, {cells_.x, 1, cells_.z}, [&](int x, int, int z) { velocity_[1].at(x, 0, z) = 0; });
    Field divergence(cells_);
    for_each(glm::ivec3(0), cells_, [&](int x, int y, int z) {
        divergence.at(x, y, z) = velocity_[0].at(x + 1, y, z) - velocity_[0].at(x, y, z) +
                                 velocity_[1].at(x, y + 1, z) - velocity_[1].at(x, y, z) +
                                 velocity_[2].at(x, y, z + 1) - velocity_[2].at(x, y, z);
    });
    const std::ptrdiff_t row = pressure_.size.x, slice = row * pressure_.size.y;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for_each(glm::ivec3(0), cells_, [&](int x, int y, int z) {
            float* p = &pressure_.at(x + 1, y + 1, z + 1);
            if (y == 0) p[-row] = *p;
            const float neighbours = p[-1] + p[1] + p[-row] + p[row] + p[-slice] + p[slice];
            *p += relaxation * ((neighbours - divergence.at(x, y, z)) / 6 - *p);
        });
    for (int axis = 0; axis < 3; ++axis) {
        const glm::ivec3 step = unit[axis];
        for_each(glm::ivec3(0), velocity_[axis].size, [&](int x, int y, int z) {
            if (axis == 1 && y == 0) return;
            velocity_[axis].at(x, y, z) -=
                pressure_.at(x + 1, y + 1, z + 1) - pressure_.at(x + 1 - step.x, y + 1 - step.y, z + 1 - step.z);
        });
    }
}

void Fluid::step(float seconds, float lift, float swirl) {
    find_middles();
    confine(swirl);
    apply_forces(seconds, lift);
    make_incompressible();
    find_middles();
    carry_contents(seconds);
    carry_velocities(seconds);
}

}  // namespace tyndall::grid_models
