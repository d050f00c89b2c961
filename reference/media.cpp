#include "reference/media.h"

#include <algorithm>

namespace tyndall::reference {
namespace {

bool does_nothing(const Medium& m) {
    return m.sigma_s == glm::vec3(0) && m.sigma_a == glm::vec3(0) && m.emission == glm::vec3(0);
}

bool has_size(const Medium& m) {
    if (m.shape == Medium::Shape::grid) return m.grid && !m.grid->empty() && m.density > 0 && m.scale > 0;
    return m.half_extent.x > 0 && m.half_extent.y > 0 && m.half_extent.z > 0;
}

/// 0 * infinity counts as nothing.
dvec3 depth_of(const dvec3& sigma_t, double density_length) {
    if (density_length <= 0) return dvec3(0);
    return {sigma_t.x > 0 ? sigma_t.x * density_length : 0, sigma_t.y > 0 ? sigma_t.y * density_length : 0,
            sigma_t.z > 0 ? sigma_t.z * density_length : 0};
}

}  // namespace

void MediumSum::add(const MediumPoint& m, double density) {
    sum_.sigma_s += density * m.sigma_s;
    sum_.sigma_t += density * m.sigma_t;
    sum_.emission += density * m.emission;
    sum_.air += density * m.air;
    const dvec3 particles = m.sigma_s - m.air;
    const double weight = density * (particles.x + particles.y + particles.z);
    sum_.anisotropy += weight * m.anisotropy;
    weight_ += weight;
}

MediumPoint MediumSum::result() const {
    MediumPoint point = sum_;
    if (weight_ > 0) point.anisotropy /= weight_;
    return point;
}

Media::Media(const std::vector<Medium>& media) {
    for (const Medium& m : media) {
        if (does_nothing(m)) continue;
        if (!is_bounded(m)) {
            const dvec3 sigma_s(m.sigma_s);
            const dvec3 air = m.rayleigh ? sigma_s : dvec3(0);
            unbounded_.push_back({{sigma_s, sigma_s + dvec3(m.sigma_a), dvec3(m.emission), m.anisotropy, air},
                                  m.height_profile,
                                  m.base,
                                  m.falloff});
        } else if (has_size(m)) {
            shapes_.emplace_back(m);
        }
    }
}

bool Media::empty() const {
    return unbounded_.empty() && shapes_.empty();
}

MediumPoint Media::at(dvec3 point) const {
    MediumSum sum;
    for (const Unbounded& m : unbounded_) sum.add(m.at_density_1, m.density(point.y));
    for (const MediumShape& m : shapes_)
        sum.add({m.sigma_s, m.sigma_t, m.emission, m.anisotropy}, m.density(point));
    return sum.result();
}

bool Media::noisy() const {
    return std::ranges::any_of(shapes_, [](const MediumShape& m) { return m.noisy(); });
}

std::vector<double> Media::breakpoints(dvec3 origin, dvec3 unit_direction, double begin, double end) const {
    std::vector<double> all;
    for (const MediumShape& m : shapes_) {
        const auto path = m.path(origin, unit_direction);
        if (!path) continue;
        const std::vector<double> knots = m.knots(*path, begin, end, true);
        all.insert(all.end(), knots.begin(), knots.end());
    }
    std::erase_if(all, [&](double t) { return !(t > begin && t < end); });
    std::sort(all.begin(), all.end());
    return all;
}

dvec3 Media::unbounded_depth(double y, double rise, double length, bool global) const {
    dvec3 depth(0);
    for (const Unbounded& m : unbounded_)
        if (m.height || global) depth += depth_of(m.at_density_1.sigma_t, m.density_length(y, rise, length));
    return depth;
}

dvec3 Media::optical_depth(dvec3 origin, dvec3 unit_direction, double begin, double end, bool global,
                           const DepthTolerance& tolerance) const {
    dvec3 depth = unbounded_depth(origin.y + begin * unit_direction.y, unit_direction.y, end - begin, global);
    for (const MediumShape& m : shapes_) {
        const double thickest = std::max({m.sigma_t.x, m.sigma_t.y, m.sigma_t.z});
        if (thickest <= 0) continue;
        if (const auto path = m.path(origin, unit_direction))
            depth += depth_of(m.sigma_t, m.density_length(*path, begin, end, tolerance.over(thickest)));
    }
    return depth;
}

glm::bvec3 Media::channels() const {
    glm::bvec3 any(false);
    const auto add = [&](const dvec3& sigma_s, const dvec3& emission) {
        for (int i = 0; i < 3; ++i) any[i] = any[i] || sigma_s[i] > 0 || emission[i] > 0;
    };
    for (const Unbounded& m : unbounded_) add(m.at_density_1.sigma_s, m.at_density_1.emission);
    for (const MediumShape& m : shapes_) add(m.sigma_s, m.emission);
    return any;
}

bool Media::has_air() const {
    return std::ranges::any_of(unbounded_, [](const Unbounded& m) { return m.at_density_1.air != dvec3(0); });
}

}  // namespace tyndall::reference
