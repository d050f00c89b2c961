#include "compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/reference.h"

namespace tyndall::stress {
namespace {

constexpr int pixels_per_frame = 3;

double mean_of(const Image& image) {
    double sum = 0;
    for (const float v : image.pixels) sum += v;
    return sum / static_cast<double>(image.pixels.size());
}

bool has_lamp(const StressFrame& frame) {
    return std::ranges::any_of(frame.lights, [](const auto& lamp) { return lamp.light.type != LightType::sun; });
}

/// Length of the longest segment of a ray, m: the last one.
double longest_segment(const volumetrics::Settings& settings, double length) {
    const double n = settings.march.steps;
    if (settings.march.stepping == volumetrics::Stepping::uniform || n == 1) return length / n;
    const double growth = settings.march.stepping_strength / (n - 1);
    return length * std::expm1(growth) / std::expm1(growth * n) * std::exp(settings.march.stepping_strength);
}

/// Over the longest segment of a ray that ends `distance` metres away, how often the density of a height medium
/// grows e-fold.
double folds(const StressFrame& frame, double direction_y, double distance) {
    const double length = std::min<double>(distance, frame.options.volumetrics.march.max_distance);
    double most = 0;
    for (const Medium& medium : frame.media)
        if (medium.shape == Medium::Shape::height) most = std::max(most, std::abs(direction_y) / medium.falloff);
    return most * longest_segment(frame.options.volumetrics, length);
}

/// See the header.
bool scattering_is_comparable(const StressFrame& frame, double folds, double distance) {
    const bool mixture = frame.media.size() > 1;
    if (folds == 0 || (!mixture && !has_lamp(frame))) return true;
    return folds <= 1 && (!mixture || distance <= frame.options.volumetrics.march.max_distance);
}

/// Relative bound of the scattering layer.
double relative_bound(const StressFrame& frame, double folds) {
    const double steps = frame.options.volumetrics.march.steps;
    double bound = 4e-3;
    if (frame.options.render.ambient > 0) bound += 0.02;
    if (frame.media.size() > 1) bound += 0.1 * folds;
    if (has_lamp(frame)) bound += 0.03 + 0.4 / steps;
    return bound;
}

struct PixelRay {
    glm::dvec3 origin, direction;
    double begin;  ///< m along the ray, where the near plane is
};

PixelRay pixel_ray(const View& view, glm::ivec2 size, glm::ivec2 pixel) {
    const double tan_y = 1 / static_cast<double>(view.projection[1][1]);
    const double tan_x = 1 / static_cast<double>(view.projection[0][0]);
    const glm::dvec3 local((2 * (pixel.x + 0.5) / size.x - 1) * tan_x, (1 - 2 * (pixel.y + 0.5) / size.y) * tan_y,
                           -1);
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(glm::mat3(view.view)));
    return {glm::dvec3(view.eye), glm::normalize(to_world * local), view.znear * glm::length(local)};
}

}  // namespace

void compare_with_truth(const StressFrame& frame, const Scene& scene, const Layers& layers, Random& random,
                        Comparison& total, Findings& findings) {
    const auto& chosen = frame.options.volumetrics;
    const reference::Settings settings{
        .light_transmittance = chosen.light.transmittance,
        .phase = {.kind = static_cast<reference::ParticlePhase::Kind>(chosen.light.phase),
                  .back_anisotropy = chosen.light.back_anisotropy,
                  .back_weight = chosen.light.back_weight},
        .shadows = false,
        .ambient = frame.options.render.ambient,
        .black_surfaces = true,
        .tolerance = 1e-4};
    const reference::Reference truth(scene, settings);
    const double mean = mean_of(layers.scattering);
    ++total.frames;
    for (int i = 0; i < pixels_per_frame; ++i) {
        const glm::ivec2 pixel(random.below(frame.size.x), random.below(frame.size.y));
        const PixelRay ray = pixel_ray(frame.view, frame.size, pixel);
        const auto expected = truth.trace(ray.origin, ray.direction, ray.begin);
        const auto compare = [&](const char* name, const Image& image, const glm::dvec3& right, double b,
                                 double floor) {
            for (int c = 0; c < 3; ++c) {
                const double value = image.at(pixel.x, pixel.y)[c];
                const double error =
                    std::abs(value - std::min<double>(right[c], half_max)) / (b * right[c] + floor);
                total.worst = std::max(total.worst, error);
                if (error <= 1) continue;
                findings.push_back(
                    fmt::format("{} at pixel ({}, {}) channel {} is {}, the ground truth {} with a "
                                "bound of {:.2g} on the error",
                                name, pixel.x, pixel.y, c, value, right[c], b * right[c] + floor));
                return;
            }
        };
        compare("transmittance", layers.transmittance, expected.transmittance, 1e-3, 1e-3);
        const double varies = folds(frame, ray.direction.y, expected.distance);
        if (!scattering_is_comparable(frame, varies, expected.distance)) continue;
        const double relative = relative_bound(frame, varies);
        ++total.pixels;
        compare("scattering", layers.scattering, expected.scattering, relative, 2e-3 * mean + 1e-5);
    }
}

}  // namespace tyndall::stress
