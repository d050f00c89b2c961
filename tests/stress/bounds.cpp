#include "bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "around.h"
#include "draw_scene.h"
#include "moderate.h"

namespace tyndall::stress {
namespace {

// What is not compared. Limits are what the module's README says that a technique cannot do; a fault is to be
// mended, and its rule to be deleted then.
constexpr const char* limit_slices = "limit: froxel lights local media by slices and columns";
constexpr const char* limit_nodes =
    "limit: a lamp's four nodes span more than half a mean free path or 3 m of a cone, or the lamp is on the ray";
constexpr const char* limit_mixture = "limit: a mixture whose density changes more than e-fold over a segment";
constexpr const char* limit_silhouettes = "limit: froxel mixes the light of columns over a silhouette";
constexpr const char* limit_rims = "limit: lamps take the rim of a soft medium for even over a segment";
constexpr const char* limit_columns = "limit: froxel interpolates the glow of a lamp nearer than two columns";
constexpr const char* limit_sprites = "limit: sheets and particles have lamps and local media of one point each";
constexpr const char* limit_particles = "limit: a particle has the phase function and the sun of its centre";
constexpr const char* limit_fog = "limit: the fog of fixed functions takes the media as they are at the eye";
constexpr const char* limit_edge = "limit: on the edge of a surface, within the rasteriser's grid";
constexpr const char* limit_nearest_caster = "limit: a lamp closer than 2 cm to a surface shines through it";
constexpr const char* limit_screen = "limit: radial_shafts sees shadows only of what is on screen";

double largest(const dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

bool has_lamp(const Truth& truth) {
    return std::ranges::any_of(truth.scene().lights, [](const Light& light) {
        return light.type != LightType::sun && light.intensity != glm::vec3(0);
    });
}

bool has_mixture(const Truth& truth) {
    return std::ranges::count_if(truth.scene().media, [](const Medium& m) { return !is_bounded(m); }) > 1;
}

bool is_anisotropic(const Truth& truth) {
    return std::ranges::any_of(truth.scene().media,
                               [](const Medium& m) { return m.anisotropy != 0 || m.rayleigh; });
}

/// Length of a march's segment at a distance along `length` metres, m.
double segment_at(const volumetrics::Settings& settings, double length, double distance) {
    const double n = settings.march.steps;
    if (settings.march.stepping == volumetrics::Stepping::uniform || n == 1) return length / n;
    // Segment i begins at length (exp(s i / n) - 1) / growth.
    const double s = settings.march.stepping_strength, growth = std::expm1(s);
    return std::min((std::clamp(distance, 0.0, length) + length / growth) * std::expm1(s / n), length);
}

/// Thickness of a froxel slice at a view depth, m.
double slice_at(const volumetrics::Settings& settings, double depth) {
    const double n = settings.froxels.z, far = settings.froxels.far;
    using enum volumetrics::DepthDistribution;
    const double first = far / 256;
    if (settings.froxels.distribution == exponential)
        return depth < 1.1 * first ? 1.1 * first : depth * std::log(256.0) / n;
    if (settings.froxels.distribution == logarithmic) return (depth + far / 32) * std::log(33.0) / n;
    return far / n;
}

double marched(const StressFrame& frame, const Truth::Pixel& pixel) {
    return std::min<double>(pixel.open.distance, frame.options.volumetrics.march.max_distance);
}

/// The part of a ray within which a technique takes a lamp's medium, cone and range from four nodes, m.
double node_span(const StressFrame& frame, const Truth::Pixel& pixel, double distance) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    const double length = marched(frame, pixel);
    if (v.technique == "froxel") return slice_at(v, distance * pixel.ray.view_cosine);
    if (v.technique == "shaft_geometry") return length / v.shaft_geometry.lamp_parts;
    return segment_at(v, length, distance);
}

/// Where on a marched ray less than 1% is left of the light in its clearest channel.
double visible_end(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    constexpr double opaque = 4.6;
    const auto clearest = [&](double t) {
        const dvec3 depth = truth.media().optical_depth(pixel.ray.origin, pixel.ray.direction, 0, t, true, 1e-3);
        return std::min({depth.x, depth.y, depth.z});
    };
    double begin = 0, end = marched(frame, pixel);
    if (clearest(end) < opaque) return end;
    for (int i = 0; i < 12; ++i) (clearest(0.5 * (begin + end)) < opaque ? begin : end) = 0.5 * (begin + end);
    return end;
}

/// Over the longest segment of the part of a ray that is seen, how often the density of a height medium grows
/// e-fold.
double folds(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel, double end) {
    double most = 0;
    for (const Medium& medium : truth.scene().media)
        if (medium.shape == Medium::Shape::height)
            most = std::max(most, std::abs(pixel.ray.direction.y) / medium.falloff);
    return most * segment_at(frame.options.volumetrics, marched(frame, pixel), end);
}

double depth_of(const reference::Media& media, const PixelRay& ray, double distance) {
    return largest(media.optical_depth(ray.origin, ray.direction, 0, distance, true, 1e-4));
}

double local_depth(const Truth& truth, const PixelRay& ray, double distance) {
    return depth_of(truth.local_media(), ray, distance);
}

/// Of the optical depth of local media as froxels hold it for their light: half a slice at each end, and linear
/// interpolation between columns.
double quantisation(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    const double end = pixel.open.distance;
    double error = 0;
    for (const reference::MediumShape& shape : truth.local_media().shapes()) {
        const auto path = shape.path(pixel.ray.origin, pixel.ray.direction);
        if (!path || path->inside.end <= 0 || path->inside.begin >= end) continue;
        for (const double t : {path->inside.begin, path->inside.end}) {
            const double at = std::clamp(t, 0.0, end);
            const double width = slice_at(v, at * pixel.ray.view_cosine);
            error += 0.5 * width * largest(shape.sigma_t) * shape.greatest_density();
        }
    }
    const double middle = local_depth(truth, pixel.ray, end);
    const glm::dvec2 column = glm::dvec2(frame.size) / glm::dvec2(v.froxels.x, v.froxels.y);
    for (const glm::dvec2 step : {glm::dvec2(column.x, 0), glm::dvec2(0, column.y)}) {
        double around = 0;
        for (const double side : {-1.0, 1.0})
            around += local_depth(truth, pixel_ray(frame.view, frame.size, pixel.place + side * step), end);
        error += 0.5 * std::abs(around - 2 * middle);
    }
    return error;
}

/// What four nodes leave of the light of lamps (shaders/lib/lamp_segment.glsl): up to 0.5% of an optical depth of
/// 0.5, and 4.6% of phase functions of |g| = 0.6 where a segment is as long as its distance from the lamp or
/// longer; 3% of the rim of a spot's cone. None: segments of a larger depth, cones in long ones, or a lamp on the
/// ray.
std::optional<double> node_error(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    constexpr double nearest_measured = 0.02, longest_in_cone = 3;  // m
    double error = 0;
    for (const Light& light : truth.scene().lights) {
        if (light.type == LightType::sun || light.intensity == glm::vec3(0)) continue;
        const dvec3 place(truth.scene().nodes[static_cast<std::size_t>(light.node)].world[3]);
        const double nearest =
            std::clamp(glm::dot(place - pixel.ray.origin, pixel.ray.direction), 0.0, marched(frame, pixel));
        const dvec3 point = pixel.ray.origin + nearest * pixel.ray.direction;
        const double aside = glm::distance(point, place);
        if (aside > light.range) continue;
        const double span = std::min(node_span(frame, pixel, nearest), 2.0 * light.range);
        const bool spot = light.type == LightType::spot;
        if (span * largest(truth.media().at(point).sigma_t) > 0.5 || (spot && span > longest_in_cone) ||
            aside < nearest_measured)
            return {};
        error = std::max(error, 0.005 + 0.046 * span / (span + aside) + (spot ? 0.03 : 0));
    }
    return error;
}

/// By how much height media change the sun over the three mean free paths that one sees, relative.
double sun_change(const Truth& truth, const Truth::Pixel& pixel) {
    const std::optional<std::size_t> sun = truth.scene().sun();
    if (!sun) return 0;
    const auto node = static_cast<std::size_t>(truth.scene().lights[*sun].node);
    const double to_sun_y = glm::normalize(glm::dvec3(truth.scene().nodes[node].world[2])).y;
    double sigma_t = 0, height_sigma_t = 0;
    for (const Medium& medium : truth.scene().media) {
        if (is_bounded(medium)) continue;
        const double own = largest(dvec3(medium.sigma_s + medium.sigma_a));
        const bool height = medium.shape == Medium::Shape::height;
        const double density = height ? std::exp((medium.base - pixel.ray.origin.y) / medium.falloff) : 1;
        sigma_t += own * density;
        if (height) height_sigma_t += own * density;
    }
    if (height_sigma_t == 0) return 0;
    const double seen = std::min(3 / sigma_t, pixel.open.distance);  // m
    return std::expm1(
        std::min(height_sigma_t * seen * std::abs(pixel.ray.direction.y) / std::max(to_sun_y, 0.01), 3.0));
}

/// Rays a column of froxels aside see surfaces at other distances: its light is mixed with theirs.
bool mixes_columns(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    const auto& froxels = frame.options.volumetrics.froxels;
    const glm::dvec2 column = glm::dvec2(frame.size) / glm::dvec2(froxels.x, froxels.y);
    for (const glm::dvec2 step : {glm::dvec2(column.x, 0), {-column.x, 0}, {0, column.y}, {0, -column.y}}) {
        const double there = truth.visible_distance(pixel_ray(frame.view, frame.size, pixel.place + step));
        if (std::min(there, pixel.open.distance) < 0.7 * std::max(there, pixel.open.distance)) return true;
    }
    return false;
}

bool passes_near_lamp(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    for (const Light& light : truth.scene().lights) {
        if (light.type == LightType::sun || light.intensity == glm::vec3(0)) continue;
        const dvec3 place(truth.scene().nodes[static_cast<std::size_t>(light.node)].world[3]);
        const double nearest = std::max(glm::dot(place - pixel.ray.origin, pixel.ray.direction), 0.0);
        const double width = 2 * nearest / frame.view.projection[1][1] / std::min(v.froxels.x, v.froxels.y);
        if (glm::distance(pixel.ray.origin + nearest * pixel.ray.direction, place) < 4 * width) return true;
    }
    return false;
}

/// A lamp in the picture, or as near to it as a block of the low resolution is wide.
bool shows_lamp(const StressFrame& frame) {
    constexpr float block = 8;  // px
    return std::ranges::any_of(frame.lights, [&](const StressFrame::Lamp& lamp) {
        const glm::vec4 clip = frame.view.projection * frame.view.view * lamp.pose[3];
        const glm::vec2 most = (1.0f + block / glm::vec2(frame.size)) * clip.w;
        return lamp.light.type != LightType::sun && lamp.light.intensity != glm::vec3(0) && clip.w > 0 &&
               std::abs(clip.x) < most.x && std::abs(clip.y) < most.y;
    });
}

/// Of the optical depth of local media along a ray, relative to that without noise, as the module's shaders state
/// it: of soft discs flatter than 4 to 1, and of noise, which they know by columns of froxels, as measured.
double depth_error(const Truth& truth) {
    double error = 0.02;
    for (const Medium& medium : truth.scene().media) {
        if (!is_bounded(medium)) continue;
        const glm::vec3 size = medium.half_extent;
        const bool disc = std::max({size.x, size.y, size.z}) > 4 * std::min({size.x, size.y, size.z});
        if (medium.shape != Medium::Shape::box && medium.softness > 0 && disc) error = std::max(error, 0.1);
        if (medium.noise_scale > 0 && medium.noise_amount > 0) error = std::max(error, 0.5);
    }
    return error;
}

/// The march looks up a lamp's shadow once a segment: fewer than four times over the lamp's range.
bool samples_lamps_coarsely(const StressFrame& frame) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    return v.technique == "ray_march" && std::ranges::any_of(frame.lights, [&](const StressFrame::Lamp& lamp) {
               const double distance = glm::distance(frame.view.eye, glm::vec3(lamp.pose[3]));
               return lamp.light.type != LightType::sun && lamp.light.shadow &&
                      segment_at(v, v.march.max_distance, distance) > 0.25 * lamp.light.range;
           });
}

/// Rays of the same pixel that lie apart by no more than a rasteriser tells end on surfaces of their own.
bool sees_an_edge(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    constexpr double grid = 1.0 / 256;  // px
    for (const glm::dvec2 aside : {glm::dvec2(grid, 0), {-grid, 0}, {0, grid}, {0, -grid}}) {
        const double distance = truth.visible_distance(pixel_ray(frame.view, frame.size, pixel.place + aside));
        if (std::isinf(distance) != std::isinf(pixel.open.distance) ||
            std::abs(distance - pixel.open.distance) > 0.02 * pixel.open.distance)
            return true;
    }
    return false;
}

/// What casts a lamp's shadow begins 2 cm from it (engine/render/shadow_tiles.cpp). Looks from both sides of
/// surfaces.
bool lamp_touches_surface(const Truth& truth) {
    constexpr double reach = 0.02 * std::numbers::sqrt3;  // m; that of the corners of a cube, too
    for (const Light& light : truth.scene().lights) {
        if (light.type == LightType::sun || light.intensity == glm::vec3(0) || !light.shadow) continue;
        const dvec3 place(truth.scene().nodes[static_cast<std::size_t>(light.node)].world[3]);
        for (int i = 0; i < 27; ++i) {
            if (i == 13) continue;
            const dvec3 direction = glm::normalize(dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
            if (truth.visible_distance({place, direction, 0, 1}) < reach ||
                truth.visible_distance({place + reach * direction, -direction, 0, 1}) < reach)
                return true;
        }
    }
    return false;
}

/// The rim of a soft medium in the ray's way is so thin that density changes within a segment, which lamps see as
/// even.
bool has_thin_rim(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    std::size_t i = 0;
    for (const Medium& medium : truth.scene().media) {
        if (!is_bounded(medium)) continue;
        const auto path = truth.local_media().shapes()[i++].path(pixel.ray.origin, pixel.ray.direction);
        if (medium.softness == 0 || !path || path->inside.end <= 0) continue;
        const double at = std::clamp(path->inside.end, 0.0, pixel.open.distance);
        if (medium.softness < 4 * segment_at(frame.options.volumetrics, marched(frame, pixel), at)) return true;
    }
    return false;
}

Bound left_out(const char* rule) {
    return {.rule = rule};
}

}  // namespace

Bound transmittance_bound(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    constexpr double half = 1e-3;  // rounding, and Beer-Lambert as the module's README states it
    if (sees_an_edge(frame, truth, pixel)) return left_out(limit_edge);
    const double smooth = depth_of(truth.smooth_media(), pixel.ray, pixel.open.distance);
    if (smooth == 0) return {half, half};
    const std::string technique = frame.options.volumetrics.technique;
    if (technique != "reference") return {half + depth_error(truth) * smooth, half};
    return {2 * half, half};
}

Bound scattering_bound(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    const std::string technique = frame.options.volumetrics.technique;
    const bool lamps = has_lamp(truth), mixture = has_mixture(truth);
    const double local = local_depth(truth, pixel.ray, pixel.open.distance);
    if (sees_an_edge(frame, truth, pixel)) return left_out(limit_edge);
    if (truth.has_shadows() && lamp_touches_surface(truth)) return left_out(limit_nearest_caster);
    Bound bound{4e-3, 2e-3};
    if (frame.options.render.ambient > 0) bound.relative += 0.02;
    const bool automatic = technique == "auto";
    const bool march = automatic || technique == "ray_march" || technique == "epipolar";
    const bool froxel = technique == "froxel" || (automatic && lamps);
    if (march || froxel || technique == "shaft_geometry") {
        const double end = visible_end(frame, truth, pixel), varies = folds(frame, truth, pixel, end);
        if ((mixture || lamps) && varies > 1) return left_out(limit_mixture);
        const bool tail = end == marched(frame, pixel) && pixel.open.distance > v.march.max_distance;
        if (varies > 0 && end < marched(frame, pixel)) bound.relative += 0.01;
        if (mixture) bound.relative += 0.1 * varies + (tail ? 0.06 : 0);
        const std::optional<double> nodes = node_error(frame, truth, pixel);
        if (!nodes) return left_out(limit_nodes);
        bound.relative += *nodes;
        if (froxel && (lamps || local > 0) && mixes_columns(frame, truth, pixel))
            return left_out(limit_silhouettes);
        if (froxel && !automatic && lamps && passes_near_lamp(frame, truth, pixel)) return left_out(limit_columns);
        if (froxel) bound.relative += 0.015;
    } else if (technique == "particles") {
        if (lamps || local > 0) return left_out(limit_sprites);
        if (v.light.phase != volumetrics::PhaseFunction::henyey_greenstein || !truth.is_homogeneous() ||
            is_anisotropic(truth))
            return left_out(limit_particles);
    } else if (technique == "billboards") {
        if (lamps || local > 0) return left_out(limit_sprites);
        bound.relative += 0.3 + sun_change(truth, pixel);  // measured: 0.18, of eight sheets or more
    } else if (technique == "analytic_fog" || technique == "radial_shafts") {
        const bool screen = technique == "radial_shafts";
        if (screen && (frame.world != World::nothing || v.radial_shafts.unseen < 1)) return left_out(limit_screen);
        if (!screen && v.analytic_fog.mode != volumetrics::FogMode::height && !truth.is_homogeneous())
            return left_out(limit_fog);
        if (mixture) bound.relative += 0.01;
    }
    if (technique == "reference" && lamps) bound.relative += 0.006;
    if (froxel && !truth.local_media().empty()) {  // also of a ray beside them
        const double quantised = quantisation(frame, truth, pixel);
        if (quantised > std::min(0.02, 0.25 * local)) return left_out(limit_slices);
        if (local > 0) bound.relative += quantised + 0.02;
    }
    if (march && lamps && has_thin_rim(frame, truth, pixel)) return left_out(limit_rims);
    if (local > 0 && march) bound.relative += 0.04 + depth_error(truth);
    if (!truth.local_media().empty() && v.light.transmittance && technique != "reference")
        bound.relative += 0.08;  // light volumes
    return bound;
}

// Measured where the few pixels lie along a shadow's edge: up to 0.057, with local media 0.154, of the columns of
// froxels 0.117, of a lamp's range in few segments 0.068.
double shadow_bound(const StressFrame& frame) {
    const bool coarse = std::ranges::any_of(frame.media, is_bounded) ||
                        holds_froxels(frame.options.volumetrics.technique) || samples_lamps_coarsely(frame);
    // Lamps of shaft_geometry: once in each of a ray's parts, however few.
    if (frame.options.volumetrics.technique == "shaft_geometry") return 0.4;
    return coarse ? 0.2 : 0.08;
}

std::string light_differs_from_plain(const StressFrame& frame) {
    const std::string& technique = frame.options.volumetrics.technique;
    // Particles hold the light of lamps in cells that are wider.
    if (frame.feature != Feature::low_resolution || technique == "particles" || !shows_lamp(frame)) return "";
    return "limit: the glow of a lamp in the picture changes within a block of the low resolution";
}

std::string differs_from_plain(const StressFrame& frame, bool shadows) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    const bool history = frame.feature == Feature::history;
    if (frame.options.volumetrics.technique == "radial_shafts" &&
        (frame.world != World::nothing || v.radial_shafts.unseen < 1))
        return limit_screen;
    if (frame.options.volumetrics.technique == "particles" && history)
        return "limit: without a history particles stand still, so that it is no mean of plain frames";
    if (holds_froxels(frame.options.volumetrics.technique) && history && shadows)
        return "limit: the history of froxels samples visibility beside the ray, too";
    if (!filters_shares(frame)) return "";
    if (shadows && !counts_all_frames(frame))
        return "limit: a share of a pixel's own light is no mean of the light around";
    return "";
}

bool filters_shares(const StressFrame& frame) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    if (frame.feature != Feature::filter && frame.feature != Feature::history) return false;
    if (frame.feature == Feature::history && v.temporal.place == volumetrics::TemporalPlace::after) return false;
    if (frame.options.volumetrics.technique == "radial_shafts") return true;
    if (v.filter.reconstruct == volumetrics::Reconstruct::light) return false;
    return frame.options.volumetrics.technique == "shaft_geometry" ||
           frame.options.volumetrics.technique == "ray_march";
}

}  // namespace tyndall::stress
