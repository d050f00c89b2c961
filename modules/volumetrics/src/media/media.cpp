#include "media/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/error.h"
#include "light/few_lamps.h"
#include "media/froxel_tiles.h"
#include "media/shape.h"
#include "reconstruction/noise.h"
#include "reconstruction/reconstruction.h"
#include "shaders/lib/glm_subset.h"
#include "shaders/shared/lights.h"
#include "volumetrics/technique.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/phase.glsl"
TYNDALL_GLSL_END

namespace tyndall::volumetrics {
namespace {

bool is_zero(glm::vec3 v) {
    return v == glm::vec3(0);
}
template <class M>
bool does_nothing(const M& medium) {
    return is_zero(medium.sigma_s) && is_zero(medium.sigma_a) && is_zero(medium.emission);
}
/// Beyond the rounding of sigma_s + sigma_a.
bool is_coloured(glm::vec3 sigma_t) {
    const float most = std::max({sigma_t.r, sigma_t.g, sigma_t.b});
    return most - std::min({sigma_t.r, sigma_t.g, sigma_t.b}) > 1e-5F * most;
}
float mean(glm::vec3 v) {
    return (v.r + v.g + v.b) / 3;
}

void add_homogeneous(const GlobalMedium& medium, shared::VolumetricsData& data) {
    glm::vec4& s = data.homogeneous_sigma_s;
    if (medium.rayleigh) {
        data.homogeneous_rayleigh += glm::vec4(medium.sigma_s, 0);
    } else {
        const float before = std::max(mean(s - data.homogeneous_rayleigh), 0.0F), added = mean(medium.sigma_s);
        if (before + added > 0) s.w = (s.w * before + medium.anisotropy * added) / (before + added);
    }
    s += glm::vec4(medium.sigma_s, 0);
    data.homogeneous_sigma_t += glm::vec4(medium.sigma_s + medium.sigma_a, 0);
    data.homogeneous_emission += glm::vec4(medium.emission, 0);
}

shared::HeightMedium pack_height(const GlobalMedium& medium) {
    return {.sigma_s_base = {medium.sigma_s, medium.base},
            .sigma_t_falloff = {medium.sigma_s + medium.sigma_a, medium.falloff},
            .emission_g = {medium.emission, medium.rayleigh ? 0.0F : medium.anisotropy},
            .sigma_s_rayleigh = {medium.rayleigh ? medium.sigma_s : glm::vec3(0), 0}};
}

/// Its place among the grids, and from its frame to voxels, of which the lowest that holds something is 0.
void pack_grid(const LocalMedium& medium, const Grids& grids, shared::LocalMedium& packed) {
    const glm::dmat4 to_world =
        glm::translate(glm::dmat4(1), glm::dvec3(medium.center)) * glm::mat4_cast(glm::dquat(medium.rotation));
    const glm::dmat4 to_voxel =
        glm::translate(glm::dmat4(1), -glm::dvec3(medium.grid->lower)) * medium.world_to_voxel * to_world;
    const glm::mat4 rows = glm::transpose(glm::mat4(to_voxel));
    packed.grid_x = rows[0];
    packed.grid_y = rows[1];
    packed.grid_z = rows[2];
    packed.grid_value.x = medium.grid->greatest;
    packed.seed_grid.y = static_cast<unsigned>(std::ranges::find(grids, medium.grid) - grids.begin());
    packed.seed_grid.z = medium.nearest ? 1 : 0;
    packed.seed_grid.w = medium.grid->number;
}

shared::LocalMedium pack_local(const LocalMedium& medium, const Grids& grids) {
    const bool noise = medium.noise_scale > 0 && medium.noise_amount > 0;
    shared::LocalMedium packed = pack_shape(medium);
    packed.sigma_s_g = {medium.sigma_s, medium.anisotropy};
    packed.sigma_a_shape = {medium.sigma_a, packed.sigma_a_shape.w};
    packed.emission_noise = {medium.emission, noise ? medium.noise_amount : 0.0F};
    packed.noise_height = {medium.noise_scale, 0, medium.base, medium.height ? medium.falloff : 0.0F};
    packed.seed_grid.x = medium.noise_seed;
    if (medium.shape == Shape::grid) pack_grid(medium, grids, packed);
    return packed;
}

void add_global(const Inputs& inputs, FrameMedia& media) {
    std::size_t heights = 0;
    for (const GlobalMedium& medium : inputs.global) {
        if (does_nothing(medium)) continue;
        media.has_global = true;
        media.rayleigh |= medium.rayleigh;
        media.chromatic |= medium.rayleigh || is_coloured(medium.sigma_s + medium.sigma_a);
        if (!medium.height)
            add_homogeneous(medium, media.data);
        else if (heights++ < MAX_HEIGHT_MEDIA)
            media.data.height[heights - 1] = pack_height(medium);
    }
    if (heights > MAX_HEIGHT_MEDIA)
        throw Error(fmt::format("volumetrics: {} height media, at most {} expected", heights, MAX_HEIGHT_MEDIA));
    media.data.height_media_count = static_cast<unsigned>(heights);
}

void add_local(const LocalMedium& medium, const ViewBounds& bounds, FrameMedia& media) {
    media.local.push_back(pack_local(medium, media.grids));
    media.local_bounds.push_back(bounds);
    media.local_emission |= !is_zero(medium.emission);
    media.local_noise |= media.local.back().emission_noise.w > 0;
    media.chromatic |= is_coloured(medium.sigma_s + medium.sigma_a);
}

void gather_grids(const Inputs& inputs, FrameMedia& media) {
    for (const LocalMedium& medium : inputs.local) {
        if (medium.shape != Shape::grid) continue;
        if (!medium.grid)
            throw Error("volumetrics: a medium of shape grid without a grid; set_grid() gives it one");
        if (does_nothing(medium) || is_empty(medium)) continue;
        if (std::ranges::find(media.grids, medium.grid) == media.grids.end()) media.grids.push_back(medium.grid);
        media.uses_grids |= may_matter(medium, inputs);
    }
}

/// Those in view. For the technique reference all, also those that only attenuate light on its way to another: if
/// any is in view, or a global medium is.
void add_local(const Inputs& inputs, bool unseen, FrameMedia& media) {
    bool seen = media.has_global;
    for (const LocalMedium& medium : inputs.local) {
        if (does_nothing(medium) || (medium.shape == Shape::grid && !media.uses_grids)) continue;
        const bool empty = is_empty(medium);
        const ViewBounds bounds = empty ? ViewBounds() : view_bounds(medium, inputs);
        seen |= bounds.in_view();
        if (bounds.in_view() || unseen) add_local(medium, bounds, media);
    }
    if (seen) return;
    media.local.clear();
    media.local_bounds.clear();
}

/// Whatever the view: what dims the light of a place in view may be out of it, and volumes of all media outlast a
/// turn of the camera.
void add_attenuating(const Inputs& inputs, FrameMedia& media) {
    for (const LocalMedium& medium : inputs.local) {
        if (is_zero(medium.sigma_s + medium.sigma_a) || is_empty(medium)) continue;
        if (medium.shape == Shape::grid && !media.uses_grids) continue;
        AttenuatingMedium added{medium, pack_local(medium, media.grids)};
        added.packed.sigma_s_g.w = 0;
        added.packed.emission_noise = {0, 0, 0, added.packed.emission_noise.w};
        media.attenuating.push_back(added);
        media.chromatic |= is_coloured(medium.sigma_s + medium.sigma_a);
    }
}

void set_froxels(const Inputs& inputs, const Settings& settings, FrameMedia& media) {
    const FroxelGrid grid = froxel_grid(inputs, settings);
    for (const ViewBounds& bounds : media.local_bounds) media.local_froxels.push_back(froxel_bounds(bounds, grid));
    media.data.froxel_distribution = static_cast<unsigned>(grid.distribution);
    media.data.froxel_begins = grid.begins;
    media.data.froxel_lengths = grid.lengths;
    media.data.froxel_depths = {grid.nearest, grid.farthest, 0, 0};
}

/// Segment i of N has the length first * ratio^i of the ray, which sums to 1; the last is ratio^(N-1) = e^strength
/// times the first. Strength 0 is uniform.
void set_stepping(const Settings& settings, shared::VolumetricsData& data) {
    const double n = settings.march.steps;
    double first = 1 / n, ratio = 1;
    if (settings.march.stepping == Stepping::exponential && settings.march.steps > 1) {
        const double growth = settings.march.stepping_strength / (n - 1);
        ratio = std::exp(growth);
        first = std::expm1(growth) / std::expm1(growth * n);
    }
    data.max_distance = settings.march.max_distance;
    data.first_step = static_cast<float>(first);
    data.step_growth = static_cast<float>(ratio);
}

void set_view(const Inputs& inputs, const Settings& settings, shared::VolumetricsData& data) {
    data.inverse_projection = glm::inverse(inputs.projection);
    data.inverse_view = glm::inverse(inputs.view);
    data.eye = {inputs.eye, inputs.znear};
    const glm::vec2 size = inputs.size;
    data.viewport = {size, 1.0F / size};
    const int factor = resolution_factor(settings);
    data.target = {(inputs.size + factor - 1) / factor, static_cast<float>(factor) / size};
}

unsigned phase_option(PhaseFunction phase) {
    switch (phase) {
        case PhaseFunction::henyey_greenstein:
            return glsl::PHASE_HENYEY_GREENSTEIN;
        case PhaseFunction::schlick:
            return glsl::PHASE_SCHLICK;
        case PhaseFunction::cornette_shanks:
            return glsl::PHASE_CORNETTE_SHANKS;
        case PhaseFunction::double_henyey_greenstein:
            return glsl::PHASE_DOUBLE_HENYEY_GREENSTEIN;
        case PhaseFunction::hg_draine:
            return glsl::PHASE_HG_DRAINE;
    }
    return glsl::PHASE_ISOTROPIC;
}

void set_few_lamps(const Inputs& inputs, const Settings& settings, FrameMedia& media) {
    // Without local media a lamp is mostly one evaluation a ray.
    constexpr float least_in_clear_view = 0.1F;
    const float least = settings.automatic.least_lamp * (media.local.empty() ? least_in_clear_view : 1);
    const glm::vec3 sigma_t(media.data.homogeneous_sigma_t);
    media.few_lamps = choose_few_lamps(inputs.lamps, inputs.eye, (sigma_t.r + sigma_t.g + sigma_t.b) / 3,
                                       settings.automatic.lamps, least);
    for (std::size_t i = 0; i < MAX_FEW_LAMPS; ++i)
        media.data.few_lamps[i / 4][static_cast<int>(i % 4)] =
            i < media.few_lamps.size() ? media.few_lamps[i].index : ~0U;
    // Cores of three columns at the lamp's depth, or of one and a half slices.
    const glm::vec3 froxels = froxel_size(settings, inputs.size);
    const glm::vec2 froxel{2 / (inputs.projection[0][0] * froxels.x), 2 / (inputs.projection[1][1] * froxels.y)};
    media.data.lamp_core = 3.0F * std::max(froxel.x, froxel.y);
    media.data.lamp_core_slices = 0.75F / froxels.z;
    media.data.few_lamp_count = static_cast<std::uint32_t>(media.few_lamps.size());
}

void set_phase(const LightSettings& light, shared::VolumetricsData& data) {
    data.phase = phase_option(light.phase);
    data.second_anisotropy = light.back_anisotropy;
    data.second_weight = light.back_weight;
    if (light.phase != PhaseFunction::hg_draine) return;
    const glm::vec4 lobes = glsl::phase_of_droplets(light.droplet_diameter);
    data.droplet_anisotropy = lobes.x;
    data.second_anisotropy = lobes.y;
    data.second_alpha = lobes.z;
    data.second_weight = lobes.w;
}

}  // namespace

bool is_grid_permutation(const Permutation& p) {
    if (p.at("GRIDS") == 0) return true;
    const auto height = p.find("HEIGHT_MEDIA"), local = p.find("LOCAL_MEDIA");
    return (height == p.end() || height->second == MAX_HEIGHT_MEDIA) && (local == p.end() || local->second > 0);
}

bool is_glass_permutation(const Permutation& p) {
    if (p.at("GLASS") == 0) return true;
    const auto value = [&](const char* define, int absent) {
        const auto found = p.find(define);
        return found == p.end() ? absent : found->second;
    };
    const int lit = (value("HAS_SUN", 0) > 0 ? GLASS_SUN : 0) | (value("LAMPS", 0) > 0 ? GLASS_LAMPS : 0);
    return (p.at("GLASS") == lit || p.at("GLASS") == (lit & GLASS_SUN)) &&
           value("HEIGHT_MEDIA", MAX_HEIGHT_MEDIA) == MAX_HEIGHT_MEDIA && value("LOCAL_MEDIA", 2) > 0 &&
           value("LIGHT_VOLUMES", 1) > 0;
}

bool is_sun(const Lamp& lamp, glm::vec3 eye) {
    return glm::distance(eye, lamp.position) > 0.5F * SUN_LAMP_DISTANCE;
}

FrameMedia gather_media(const Inputs& inputs, const Settings& settings) {
    FrameMedia media;
    const TechniqueDesc& desc = technique(settings.technique);
    if (!desc.add) return media;
    if (desc.traits.glass && inputs.has_sun && inputs.sun_through_glass) media.glass |= GLASS_SUN;
    if (desc.traits.glass && inputs.has_lamps && std::ranges::any_of(inputs.lamps, &Lamp::through_glass))
        media.glass |= GLASS_LAMPS;
    add_global(inputs, media);
    if (desc.traits.local_media) {
        gather_grids(inputs, media);
        add_local(inputs, desc.traits.unseen_local_media, media);
        set_froxels(inputs, settings, media);
        if (settings.light.transmittance && (inputs.has_sun || inputs.has_lamps)) add_attenuating(inputs, media);
    }
    if (media.empty() && media.attenuating.empty()) return media;
    set_view(inputs, settings, media.data);
    set_stepping(settings, media.data);
    media.data.coloured_froxels = media.chromatic && !media.local.empty() ? 1U : 0U;
    media.data.local_media_count = static_cast<unsigned>(media.local.size());
    media.data.has_global = media.has_global ? 1U : 0U;
    media.data.local_noise = media.local_noise ? 1U : 0U;
    media.data.local_emission = media.local_emission ? 1U : 0U;
    media.data.steps = static_cast<unsigned>(settings.march.steps);
    media.data.noise_side = static_cast<unsigned>(noise_side(settings));
    media.data.noise = noise_uniform(settings, inputs.frame_index);
    set_phase(settings.light, media.data);
    media.data.grid_piece = settings.march.grid_piece;
    media.data.scattering_orders = static_cast<unsigned>(settings.light.scattering_orders);
    media.data.light_transmittance = settings.light.transmittance ? 1U : 0U;
    media.data.has_ambient = inputs.has_ambient && !inputs.has_sky_radiance ? 1U : 0U;
    media.data.further_suns = static_cast<std::uint32_t>(
        std::ranges::count_if(inputs.lamps, [&](const Lamp& l) { return is_sun(l, inputs.eye); }));
    if (desc.traits.few_lamps) set_few_lamps(inputs, settings, media);
    media.data.fog_mode = static_cast<unsigned>(settings.analytic_fog.mode);
    media.data.radial_samples = static_cast<float>(settings.radial_shafts.samples);
    media.data.radial_decay = settings.radial_shafts.decay;
    media.data.radial_unseen = settings.radial_shafts.unseen;
    return media;
}

int height_media_axis(const FrameMedia& media) {
    const int heights = static_cast<int>(media.data.height_media_count);
    return heights > 1 ? MAX_HEIGHT_MEDIA : heights;
}

}  // namespace tyndall::volumetrics
