#include "compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/reference.h"

namespace tyndall::stress {
namespace {

constexpr int pixels_per_frame = 3;
constexpr double half_max = 65504;  // where radiance is limited

double mean_of(const Image& image) {
    double sum = 0;
    for (const float v : image.pixels) sum += v;
    return sum / static_cast<double>(image.pixels.size());
}

/// Relative bound of the scattering layer.
double relative_bound(const StressFrame& frame) {
    const double steps = frame.options.volumetrics.steps;
    double bound = 4e-3;
    if (frame.options.render.ambient > 0) bound += 0.02;
    if (frame.media.size() > 1) bound += 0.1 / steps;
    for (const auto& lamp : frame.lights)
        if (lamp.light.type != LightType::sun) return bound + 0.03 + 0.4 / steps;
    return bound;
}

bool mixes_height(const StressFrame& frame) {
    return frame.media.size() > 1 && std::ranges::any_of(frame.media, [](const Medium& medium) {
               return medium.shape == Medium::Shape::height;
           });
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
    const reference::Settings settings{.light_transmittance = chosen.light_transmittance,
                                       .schlick = chosen.phase == volumetrics::PhaseFunction::schlick,
                                       .shadows = false,
                                       .ambient = frame.options.render.ambient,
                                       .black_surfaces = true,
                                       .tolerance = 1e-4};
    const reference::Reference truth(scene, settings);
    const double relative = relative_bound(frame), mean = mean_of(layers.scattering);
    ++total.frames;
    for (int i = 0; i < pixels_per_frame; ++i) {
        const glm::ivec2 pixel(random.below(frame.size.x), random.below(frame.size.y));
        const PixelRay ray = pixel_ray(frame.view, frame.size, pixel);
        const auto expected = truth.trace(ray.origin, ray.direction, ray.begin);
        ++total.pixels;
        const auto compare = [&](const char* name, const Image& image, const glm::dvec3& right, double b,
                                 double floor) {
            for (int c = 0; c < 3; ++c) {
                const double value = image.at(pixel.x, pixel.y)[c];
                const double error = std::abs(value - std::min(right[c], half_max)) / (b * right[c] + floor);
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
        const bool falls = ray.direction.y < 0 && std::isinf(expected.distance);
        if (falls && mixes_height(frame)) continue;
        compare("scattering", layers.scattering, expected.scattering, relative, 2e-3 * mean + 1e-5);
    }
}

}  // namespace tyndall::stress
