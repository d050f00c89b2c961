#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reference/brdf.h"
#include "reference/sky_table.h"
#include "reference/surface.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/sky_background.glsl"
TYNDALL_GLSL_END

namespace tyndall::reference {
namespace {

constexpr double pi = std::numbers::pi;
constexpr glm::dvec3 luminance(0.2126, 0.7152, 0.0722);
/// Width of the disc's edge, in radii: sharp.
constexpr float disc_edge = 1e-4f;

/// Where the specular lobe is sampled, as Brdf::sample takes it.
struct LobeSample {
    double u, cosine, sine;
};
std::array<LobeSample, 256> lobe_samples() {
    std::array<LobeSample, 256> samples{};
    constexpr double golden = 1 / std::numbers::phi;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double index = static_cast<double>(i), azimuth = 2 * pi * std::fmod(index * golden, 1.0);
        samples[i] = {(index + 0.5) / static_cast<double>(samples.size()), std::cos(azimuth), std::sin(azimuth)};
    }
    return samples;
}

}  // namespace

Sky::Sky(const Scene& scene, double factor)
    : factor_(factor), cirrus_(!has_clouds(scene.media)), brightest_(glsl::SKY_BRIGHTEST * scene.light_unit()) {
    const auto index = scene.sun();
    if (index) {
        const Light& sun = scene.lights[*index];
        to_sun_ = glm::normalize(dvec3(node_pose(scene, sun.node)[2]));
        illuminance_ = sun.intensity;
    }
    if (factor == 0) return;  // the table is slow to fill
    const glm::vec3 to_sun(to_sun_);
    const auto lux = static_cast<float>(glm::dot(illuminance_, luminance));
    table_ = SkyTable([&](dvec3 d) { return dvec3(glsl::sky_radiance(glm::vec3(d), to_sun, lux)); });
}

dvec3 Sky::background(dvec3 unit_direction) const {
    const glm::vec3 d(unit_direction), to_sun(to_sun_);
    const auto lux = static_cast<float>(glm::dot(illuminance_, luminance));
    const glm::vec3 clear = glsl::sky_radiance(d, to_sun, lux);
    const glm::vec3 radiance = (cirrus_ ? glsl::sky_clouded(clear, d, to_sun, lux) : clear) +
                               glsl::sky_sun_disc(d, to_sun, glm::vec3(illuminance_), disc_edge);
    return glm::min(radiance, glm::vec3(brightest_));
}

dvec3 Sky::mean_radiance() const {
    return factor_ * table_.mean();
}

dvec3 Sky::reflected(const Surface& surface, dvec3 to_eye) const {
    static const std::array<LobeSample, 256> samples = lobe_samples();
    const Brdf brdf(surface, to_eye);
    dvec3 diffuse(0), specular(0);
    for (const SkyTable::Patch& patch : table_.patches()) {
        if (surface.metallic >= 1) break;
        const double cosine = glm::dot(surface.normal, patch.direction);
        if (cosine > 0) diffuse += brdf.diffuse(patch.direction) * patch.flux * cosine;
    }
    for (const LobeSample& s : samples) {
        const auto [to_light, weight] = brdf.sample(s.u, s.cosine, s.sine);
        specular += weight * table_.at(to_light);
    }
    return factor_ * surface.occlusion * (diffuse + specular / static_cast<double>(samples.size()));
}

}  // namespace tyndall::reference
