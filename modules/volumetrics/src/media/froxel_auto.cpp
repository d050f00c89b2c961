// The distribution `auto`: slices where they lower the error most, from what is known before the frame is drawn.
//
// A slice of length h takes one sample of what the lights' visibility and the local media do within it, and so is
// wrong by about h s, s being what it sends to the eye per metre. With e edges per metre the squared error of all
// slices is the integral of h^2 s^2 e over them, h^3 s^2 e per slice; with a given number of slices, the integral
// of 1/h, it is least where h is in proportion to (s^2 e)^(-1/3). Here e falls as 1 / (depth + 2 m)^2, for the
// farther a point is the fewer pixels see it, and s is sqrt(light) * sigma_s * transmittance of the global media on
// the view axis: the root, because errors beside a lamp are seen as well as those in its glare. Known are the
// media, the lamps' places and whether the sun shines; what hides what is not.
#include <algorithm>
#include <cmath>
#include <vector>

#include "media/froxel_tiles.h"
#include "media/shape.h"

namespace tyndall::volumetrics {
namespace {

constexpr int bins = 256;

double mean(glm::vec3 v) {
    return (double(v.r) + double(v.g) + double(v.b)) / 3;
}

/// What scatters or emits in a range of view depths.
struct Layer {
    double nearest, farthest;  ///< m
    double source;             ///< 1/m, over the whole screen
};

/// Emission has another unit: it counts as scattering of what absorbs it, and a little where nothing does.
double source(glm::vec3 sigma_s, glm::vec3 sigma_a, glm::vec3 emission) {
    return mean(sigma_s) + (mean(emission) > 0 ? mean(sigma_a) + 0.01 : 0);
}

/// Mean over the shape, as far as its height profile, noise and voxels go.
double density(const LocalMedium& m) {
    if (m.shape == Shape::grid) {
        const glm::dvec3 voxels(m.grid->upper - m.grid->lower + 1);
        return m.grid->sum / (voxels.x * voxels.y * voxels.z);
    }
    const double height = 2 * double(m.half_extent.y), falloff = m.height ? double(m.falloff) : 0;
    const double profile = falloff > 0 ? falloff / height * -std::expm1(-height / falloff) : 1;
    return profile * (1 - 0.5 * std::clamp(double(m.noise_amount), 0.0, 1.0));
}

std::vector<Layer> layers_in_view(const Inputs& inputs, double far) {
    std::vector<Layer> layers;
    for (const LocalMedium& m : inputs.local) {
        const double light = source(m.sigma_s, m.sigma_a, m.emission);
        if (is_empty(m) || light + mean(m.sigma_a) <= 0) continue;
        const ViewBounds b = view_bounds(m, inputs);
        const glm::vec2 size = glm::clamp(b.upper, 0.0F, 1.0F) - glm::clamp(b.lower, 0.0F, 1.0F);
        if (b.farthest <= 0 || double(b.nearest) >= far || size.x <= 0 || size.y <= 0) continue;
        const double depth = double(b.farthest) - double(b.nearest);
        const double path = mean(m.sigma_s + m.sigma_a) * depth * density(m);
        layers.push_back({std::max(double(b.nearest), 0.0), std::min(double(b.farthest), far),
                          double(size.x) * double(size.y) * light * density(m) / (1 + path)});
    }
    return layers;
}

/// Along the view axis, at a view depth: the sum of the global media's source and extinction.
glm::dvec2 global_at(const Inputs& inputs, double depth) {
    const double forward_y = -double(inputs.view[1][2]), y = double(inputs.eye.y) + depth * forward_y;
    glm::dvec2 sum(0);
    for (const GlobalMedium& m : inputs.global) {
        const double exponent = m.height ? -(y - double(m.base)) / double(m.falloff) : 0;
        const double density = std::exp(std::clamp(exponent, -60.0, 60.0));
        sum += density * glm::dvec2(source(m.sigma_s, m.sigma_a, m.emission), mean(m.sigma_s + m.sigma_a));
    }
    return sum;
}

/// Light at a view depth, to a factor: even under a sun, else the lamps' inverse squares, beside which a sky
/// without a sun is faint, on a ray that passes them at their distance from the view, at least 1 m.
double light_at(const Inputs& inputs, double depth) {
    if (inputs.has_sun || inputs.lamps.empty()) return 1;
    double sum = 0;
    for (const Lamp& lamp : inputs.lamps) {
        const glm::dvec3 p(inputs.view * glm::vec4(lamp.position, 1));
        const double beside = std::max(1.0, std::hypot(p.x, p.y) - std::max(-p.z, 0.0));
        sum += 1 / (beside * beside + (depth + p.z) * (depth + p.z));
    }
    return sum;
}

double clamped_positive(double value) {
    return std::isfinite(value) ? std::clamp(value, 1e-12, 1e12) : 1e-12;
}

}  // namespace

DepthTable automatic_depths(const Inputs& inputs, const Settings& settings) {
    const double far = double(settings.froxels.far);
    const std::vector<Layer> layers = layers_in_view(inputs, far);
    const bool global = global_at(inputs, 0).x + global_at(inputs, 0).y > 0;
    double nearest = 0, farthest = far;
    if (!global && !layers.empty()) {
        nearest = std::ranges::min(layers, {}, &Layer::nearest).nearest;
        farthest = std::ranges::max(layers, {}, &Layer::farthest).farthest;
        farthest = std::clamp(farthest, nearest + 1e-3 * far, 2 * far);
    }

    // Bins that grow with their distance from the nearest depth.
    const double span = farthest - nearest;
    const auto edge = [&](int i) { return nearest + span * (std::pow(1025.0, double(i) / bins) - 1) / 1024; };
    std::vector<double> share(bins);
    double optical_depth = 0, total = 0;
    for (int i = 0; i < bins; ++i) {
        const double length = edge(i + 1) - edge(i), depth = (edge(i) + edge(i + 1)) / 2;
        glm::dvec2 medium = global_at(inputs, depth);
        for (const Layer& l : layers) {
            const double inside = std::min(l.farthest, edge(i + 1)) - std::max(l.nearest, edge(i));
            if (inside > 0) medium.x += l.source * inside / length;
        }
        const double sent =
            std::sqrt(light_at(inputs, depth)) * medium.x * std::exp(-optical_depth - medium.y * length / 2);
        optical_depth = std::min(optical_depth + medium.y * length, 700.0);
        share[std::size_t(i)] = length * clamped_positive(std::cbrt(std::pow(sent / (depth + 2), 2)));
        total += share[std::size_t(i)];
    }
    // Some of the slices go evenly over the bins: what is known is not all there is.
    constexpr double even = 0.3;
    for (double& s : share) s = (1 - even) * s / total + even / bins;

    DepthTable depths{};
    depths.front() = float(nearest);
    depths.back() = float(farthest);
    double before = 0;
    for (int i = 0, k = 1; i < bins && k < 16; before += share[std::size_t(i)], ++i)
        for (; k < 16 && k / 16.0 <= before + share[std::size_t(i)]; ++k)
            depths[std::size_t(k)] =
                float(edge(i) + (edge(i + 1) - edge(i)) * (k / 16.0 - before) / share[std::size_t(i)]);
    // The first slice holds all from the eye on, with the medium of its middle: that has to lie before the medium.
    const float length = (depths[1] - depths[0]) / (1 - 8.0F / float(std::max(settings.froxels.z, 16)));
    depths.front() = std::max(depths[1] - 1.05F * length, 0.0F);
    return depths;
}

}  // namespace tyndall::volumetrics
