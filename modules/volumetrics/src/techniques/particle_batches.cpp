#include "techniques/particle_batches.h"

#include <algorithm>
#include <cmath>

#include "media/shape.h"

namespace tyndall::volumetrics {
namespace {

constexpr int levels = 4;

/// Numbers of cells repeat after this many, far outside of a level.
constexpr double cell_period = 1 << 20;

float end_of_particles(const Settings& settings) {
    return std::min(settings.particle_distance, settings.max_distance);
}

double drifted(const Inputs& inputs, const Settings& settings) {
    return settings.particle_drift * inputs.time;
}

/// A level covers `side` cells around the cell of the eye; its reach leaves out what may be cut off at either end.
void add_level(const Inputs& inputs, const Settings& settings, int level, int side,
               std::vector<ParticleBatch>& batches) {
    const double cells = 0.5 * side - 1;
    const double reach = end_of_particles(settings) * std::exp2(level + 1 - levels);
    const double spacing = reach / cells;
    const glm::dvec3 wind = glm::normalize(glm::dvec3(1, 0.15, 0.4));
    const glm::dvec3 eye = glm::dvec3(inputs.eye) - wind * drifted(inputs, settings);
    const glm::dvec3 lower = glm::floor(eye / spacing) - static_cast<double>(side / 2);
    const double volume = spacing * spacing * spacing;
    batches.push_back({.count = static_cast<std::uint32_t>(side * side * side),
                       .radius = static_cast<float>(settings.particle_size * spacing),
                       .volume = static_cast<float>(volume),
                       .side = side,
                       .lower_cell = glm::ivec3(lower - cell_period * glm::floor(lower / cell_period)),
                       .lower_corner = glm::vec3(lower * spacing - eye),
                       .spacing = static_cast<float>(spacing),
                       .reach = {level == 0 ? 0.0 : 0.5 * reach, reach}});
}

/// Optical cross-section [m²]: of equal particles this gives each its number. One that only emits counts a little.
float cross_section(const shared::LocalMedium& medium) {
    const glm::vec3 sigma_t = glm::vec3(medium.sigma_s_g) + glm::vec3(medium.sigma_a_shape);
    return volume(medium) * std::max((sigma_t.r + sigma_t.g + sigma_t.b) / 3, 1e-3F);
}

void add_local(const Inputs& inputs, const Settings& settings, const FrameMedia& media,
               std::vector<ParticleBatch>& batches) {
    double total = 0;
    for (const shared::LocalMedium& medium : media.local) total += cross_section(medium);
    for (std::size_t i = 0; i < media.local.size(); ++i) {
        const double share = cross_section(media.local[i]) / total;
        const double count = std::max(32.0, std::floor(share * settings.particle_local_count));
        const float particle_volume = volume(media.local[i]) / static_cast<float>(count);
        batches.push_back({.medium = static_cast<int>(i),
                           .count = static_cast<std::uint32_t>(count),
                           .radius = settings.particle_size * std::cbrt(particle_volume),
                           .volume = particle_volume,
                           .drift = static_cast<float>(std::fmod(drifted(inputs, settings), 1e5))});
    }
}

}  // namespace

float particle_reach(const Settings& settings) {
    return 0.875F * end_of_particles(settings);
}

std::vector<ParticleBatch> particle_batches(const Inputs& inputs, const Settings& settings,
                                            const FrameMedia& media) {
    std::vector<ParticleBatch> batches;
    const int side = static_cast<int>(std::cbrt(settings.particle_count / levels) + 1e-6);
    for (int level = 0; media.has_global && level < levels; ++level)
        add_level(inputs, settings, level, side, batches);
    add_local(inputs, settings, media, batches);
    std::uint32_t first = 0;
    for (ParticleBatch& batch : batches) {
        batch.first = first;
        batch.placement = settings.temporal == Temporal::off ? 0 : media.data.noise.z;
        first += batch.count;
    }
    return batches;
}

}  // namespace tyndall::volumetrics
