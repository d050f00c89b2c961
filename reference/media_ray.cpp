#include "reference/media_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::reference {
namespace {

constexpr double opaque = 45;        ///< optical depth behind which nothing is seen: 3e-20
constexpr double farthest = 1e9;     ///< m
constexpr double heights_seen = 45;  ///< falloffs of rise after which nothing is left of a height medium

}  // namespace

MediaRay::MediaRay(const Media& media, dvec3 origin, dvec3 unit_direction, double end, double tolerance)
    : media_(&media), origin_(origin), direction_(unit_direction), channels_(media.channels()) {
    std::vector<double> edges;
    for (const MediumShape& shape : media.shapes()) {
        const auto path = shape.path(origin, unit_direction);
        if (!path) continue;
        if (shape.is_grid()) {
            Local local{*path, {}, shape.line(*path, 0, end)};
            const std::vector<double> cells = local.line.knots();
            if (cells.empty()) continue;
            edges.insert(edges.end(), cells.begin(), cells.end());
            locals_.push_back(std::move(local));
            continue;
        }
        const std::vector<double> knots = shape.knots(*path, 0, end, true);
        if (knots.empty()) continue;
        Local local{*path};
        const double thickest = std::max({shape.sigma_t.x, shape.sigma_t.y, shape.sigma_t.z});
        if (!shape.closed() && thickest > 0)
            local.table = DensityTable([&](double t) { return path->density(t); }, knots,
                                       shape.attainable(tolerance / thickest, knots.back() - knots.front()));
        locals_.push_back(std::move(local));
        const std::vector<double> kinks = shape.knots(*path, 0, end, false);
        edges.insert(edges.end(), kinks.begin(), kinks.end());
    }
    end_ = source_end(end);
    end_ = std::min(end_, where_depth_is(opaque, end_, true));
    knots_ = std::move(edges);
    find_knots();
}

double MediaRay::source_end(double end) const {
    double last = 0;
    for (const Media::Unbounded& m : media_->unbounded()) {
        if (m.height && direction_.y > 0) {
            last = std::max(last, heights_seen * m.falloff / direction_.y);
            continue;
        }
        const dvec3 sigma_t = m.density(origin_.y) * m.at_density_1.sigma_t;  // the least on this ray
        for (int i = 0; i < 3; ++i) {
            const bool source = m.at_density_1.sigma_s[i] > 0 || m.at_density_1.emission[i] > 0;
            if (source) last = std::max(last, sigma_t[i] > 0 ? opaque / sigma_t[i] : farthest);
        }
    }
    for (const Local& local : locals_) last = std::max(last, local.path.inside.end);
    return std::min(last, end);
}

MediumPoint MediaRay::at(double t) const {
    MediumSum sum;
    const double y = origin_.y + t * direction_.y;
    for (const Media::Unbounded& m : media_->unbounded()) sum.add(m.at_density_1, m.density(y));
    for (const Local& local : locals_) {
        if (t < local.path.inside.begin || t > local.path.inside.end) continue;
        const MediumShape& m = *local.path.shape;
        sum.add({m.sigma_s, m.sigma_t, m.emission, m.anisotropy}, local.path.density(t));
    }
    return sum.result();
}

dvec3 MediaRay::depth(double t) const {
    dvec3 depth = media_->unbounded_depth(origin_.y, direction_.y, t, true);
    for (const Local& local : locals_) depth += local.path.shape->sigma_t * local.density_length(t);
    return depth;
}

double MediaRay::Local::density_length(double t) const {
    const MediumShape& shape = *path.shape;
    if (shape.is_grid()) return line.integral_to(t);
    return shape.closed() ? shape.density_length(path, 0, t, 0) : table.integral_to(t);
}

// By bisection, from above; infinite where the depth stays less up to `end`.
double MediaRay::where_depth_is(double wanted, double end, bool thinnest) const {
    const auto reaches = [&](double t) {
        const dvec3 depth = this->depth(t);
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (int i = 0; i < 3; ++i) {
            if (!channels_[i]) continue;
            least = std::min(least, depth[i]);
            most = std::max(most, depth[i]);
        }
        return (thinnest ? least : most) >= wanted;
    };
    if (!reaches(end)) return std::numeric_limits<double>::infinity();
    double before = 0, after = end;
    while (after - before > 1e-3 * after) {
        const double middle = 0.5 * (before + after);
        (reaches(middle) ? after : before) = middle;
    }
    return after;
}

void MediaRay::find_knots() {
    for (const bool thinnest : {false, true})
        for (const double depth : {0.5, 2.0, 6.0, 16.0}) knots_.push_back(where_depth_is(depth, end_, thinnest));
    for (const Media::Unbounded& m : media_->unbounded()) {
        if (!m.height || direction_.y == 0) continue;
        const double scale = m.falloff / direction_.y;
        for (const double falloffs : {1.0, 3.0, 8.0, 20.0})
            knots_.push_back(falloffs * scale + (scale > 0 ? 0 : end_));
    }
    std::erase_if(knots_, [&](double t) { return !(t > 0 && t < end_); });
    knots_.push_back(0);
    knots_.push_back(end_);
    std::sort(knots_.begin(), knots_.end());
    knots_.erase(std::unique(knots_.begin(), knots_.end()), knots_.end());
}

dvec3 MediaRay::greatest_sigma_s() const {
    dvec3 sum(0);
    const double lowest = origin_.y + std::min(0.0, direction_.y * end_);
    for (const Media::Unbounded& m : media_->unbounded()) sum += m.density(lowest) * m.at_density_1.sigma_s;
    for (const Local& local : locals_) sum += local.path.shape->greatest_density() * local.path.shape->sigma_s;
    return sum;
}

double MediaRay::greatest_anisotropy() const {
    double greatest = 0;
    for (const Media::Unbounded& m : media_->unbounded())
        greatest = std::max(greatest, std::abs(m.at_density_1.anisotropy));
    for (const Local& local : locals_) greatest = std::max(greatest, std::abs(local.path.shape->anisotropy));
    return greatest;
}

}  // namespace tyndall::reference
