#include "light/epipolar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shaders/shared/lights.h"

namespace tyndall::volumetrics {
namespace {

constexpr float two_pi = 2 * std::numbers::pi_v<float>;
constexpr float sun_radius = 2;      // m: EPIPOLAR_RADIUS of epipolar.glsl
constexpr float at_the_eye = 0.02F;  // m: a lamp that near sees what the eye sees
constexpr int most_lines = 16384;
constexpr float fewest_round_the_sun = 512;

/// The directions that the picture shows.
struct Picture {
    std::array<glm::vec3, 4> corners;
    glm::vec3 middle;
    float reach;  ///< rad, from the middle to the corners
    float pixel;  ///< rad, in the middle
};

Picture picture_of(const Inputs& inputs, glm::ivec2 pixels) {
    const glm::mat4 to_view = glm::inverse(inputs.projection);
    const glm::mat3 to_world(glm::inverse(inputs.view));
    const auto direction = [&](float x, float y) {
        const glm::vec4 p = to_view * glm::vec4(x, y, 1, 1);
        return glm::normalize(to_world * (glm::vec3(p) / p.w));
    };
    Picture picture;
    picture.corners = {direction(-1, -1), direction(1, -1), direction(1, 1), direction(-1, 1)};
    picture.middle = direction(0, 0);
    picture.reach = 0;
    for (const glm::vec3& corner : picture.corners)
        picture.reach =
            std::max(picture.reach, std::acos(std::clamp(glm::dot(corner, picture.middle), -1.0F, 1.0F)));
    picture.pixel = 2 / (inputs.projection[1][1] * static_cast<float>(pixels.y));
    return picture;
}

/// A direction across the axis that depends on nothing else.
glm::vec3 across(glm::vec3 axis) {
    const glm::vec3 other = std::abs(axis.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(other - axis * glm::dot(other, axis));
}

/// First and last angle (rad) round the axis that the picture shows; a whole turn where the axis is in it.
glm::vec2 angles_in(const Picture& picture, glm::vec3 axis, glm::vec3 zero) {
    const glm::vec3 quarter = glm::cross(axis, zero);
    bool before = true, behind = true;  // on the same side of all edges
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 edge = glm::normalize(glm::cross(picture.corners[i], picture.corners[(i + 1) % 4]));
        before = before && glm::dot(edge, axis) > -1e-3F;
        behind = behind && glm::dot(edge, axis) < 1e-3F;
    }
    const auto angle = [&](glm::vec3 v) { return std::atan2(glm::dot(v, quarter), glm::dot(v, zero)); };
    if (before || behind) return {0, two_pi};
    const float middle = angle(picture.middle);
    glm::vec2 range{0};  // to both sides of the middle
    for (const glm::vec3& corner : picture.corners) {
        const float side = std::remainder(angle(corner) - middle, two_pi);
        range = {std::min(range.x, side), std::max(range.y, side)};
    }
    if (range.y - range.x > 0.95F * two_pi) return {0, two_pi};
    return {middle + range.x, middle + range.y};
}

/// Largest sine of the angles to the axis that the picture shows of what lies within `most` radians of it.
float largest_sine(const Picture& picture, glm::vec3 axis, float most) {
    const float middle = std::acos(std::clamp(glm::dot(picture.middle, axis), -1.0F, 1.0F));
    const float first = std::max(middle - picture.reach, 0.0F);
    const float last = std::min({middle + picture.reach, most, std::numbers::pi_v<float>});
    constexpr float right_angle = std::numbers::pi_v<float> / 2;
    if (first < right_angle && last > right_angle) return 1;
    return std::max({std::sin(first), std::sin(last), 1e-4F});
}

/// Lines `spacing` pixels apart, a whole number of them a turn, in steps of a quarter of an octave, so that they
/// seldom change. Small pictures have `fewest` a turn: a pixel shows one ray, however wide it is.
EpipolarLines lines_round(const Picture& picture, glm::vec3 axis, float most_angle, float spacing, float fewest) {
    EpipolarLines lines{.axis = axis};
    const float wanted = two_pi * largest_sine(picture, axis, most_angle) / (picture.pixel * spacing);
    const float turn =
        std::round(std::exp2(std::ceil(4 * std::log2(std::clamp(wanted, fewest, float(most_lines)))) / 4));
    lines.lines_per_radian = turn / two_pi;
    const glm::vec3 zero = across(axis);
    const glm::vec2 angles = angles_in(picture, axis, zero) * lines.lines_per_radian;
    const float first = std::floor(angles.x) - 1;
    lines.lines = static_cast<int>(std::min(std::ceil(angles.y) + 1 - first, turn));
    const float angle = first / lines.lines_per_radian;
    lines.first = std::cos(angle) * zero + std::sin(angle) * glm::cross(axis, zero);
    return lines;
}

/// As many as the angles to the axis that the picture shows need, and one beyond each end. Small pictures have
/// `fewest_round_the_sun` a turn: see lines_round.
void place_samples(EpipolarLines& lines, const Picture& picture, float spacing) {
    const float middle = std::acos(std::clamp(glm::dot(picture.middle, lines.axis), -1.0F, 1.0F));
    const float first = std::max(middle - picture.reach, 0.0F);
    const float last = std::min(middle + picture.reach, std::numbers::pi_v<float>);
    const float most = static_cast<float>(most_epipolar_samples - 4) / (last - first);
    lines.samples_per_radian =
        std::min(std::max(1 / (picture.pixel * spacing), fewest_round_the_sun / two_pi), most);
    lines.first_sample = std::floor(first * lines.samples_per_radian) - 1;
    lines.samples = static_cast<int>(std::ceil(last * lines.samples_per_radian) + 2 - lines.first_sample);
}

EpipolarLines sun_lines(const Picture& picture, glm::vec3 to_sun, const Settings& settings, float spacing) {
    EpipolarLines lines = lines_round(picture, to_sun, two_pi, spacing, fewest_round_the_sun);
    const float farthest = settings.march.max_distance * largest_sine(picture, to_sun, two_pi);
    lines.cells = settings.epipolar.cells;
    lines.cells_per_unit = static_cast<float>(lines.cells) / std::log1p(farthest / sun_radius);
    return lines;
}

/// `coarser`: doubles the spacing and halves the cells so often.
EpipolarLines lamp_lines(const Picture& picture, const Inputs& inputs, const Lamp& lamp, const Settings& settings,
                         int coarser) {
    const glm::vec3 to_lamp = lamp.position - inputs.eye;
    const float distance = glm::length(to_lamp);
    if (!lamp.shadow || distance < at_the_eye) return {};
    if (distance > 0.5F * SUN_LAMP_DISTANCE)
        return sun_lines(picture, to_lamp / distance, settings,
                         settings.epipolar.spacing * std::exp2(static_cast<float>(coarser)));
    const bool inside = lamp.range <= 0 || lamp.range >= distance;
    const float most_angle = inside ? two_pi : std::asin(lamp.range / distance);
    const float factor = std::exp2(static_cast<float>(coarser));
    EpipolarLines lines =
        lines_round(picture, to_lamp / distance, most_angle, settings.epipolar.lamp_spacing * factor, 32);
    lines.distance = distance;
    lines.cells = std::max(settings.epipolar.lamp_cells >> coarser, 8);
    lines.cells_per_unit = static_cast<float>(lines.cells) / std::numbers::pi_v<float>;
    return lines;
}

std::int64_t nodes_of(const EpipolarLines& lines) {
    return std::int64_t{2} * lines.lines * lines.cells;
}

}  // namespace

void EpipolarPlan::add(EpipolarLines lines, std::uint32_t index) {
    if (lines.cells == 0) return;
    lines.index = index;
    lines.nodes = static_cast<int>(nodes);
    nodes += nodes_of(lines);
    lights.push_back(lines);
}

EpipolarPlan plan_epipolar(const Inputs& inputs, const std::vector<Lamp>& lamps, const Settings& settings,
                           glm::ivec2 pixels) {
    const Picture picture = picture_of(inputs, pixels);
    EpipolarPlan with_sun;
    if (inputs.has_sun && inputs.sun_shadow) {
        float spacing = settings.epipolar.spacing;
        EpipolarLines sun = sun_lines(picture, -inputs.sun_direction, settings, spacing);
        while (nodes_of(sun) > most_epipolar_nodes / 2)
            sun = sun_lines(picture, -inputs.sun_direction, settings, spacing *= 2);
        if (samples_lines(settings)) place_samples(sun, picture, spacing);
        with_sun.add(sun, 0);
    }
    constexpr int least_pixels = 128 * 128;
    const std::int64_t rays =
        std::int64_t{std::max(pixels.x * pixels.y, least_pixels)} * settings.epipolar.lamp_rays;
    const std::int64_t most = std::min(with_sun.nodes + 2 * rays, std::int64_t{most_epipolar_nodes});
    constexpr int coarsest = 8;
    for (int coarser = 0;; ++coarser) {
        EpipolarPlan plan = with_sun;
        for (const Lamp& lamp : lamps)
            plan.add(lamp_lines(picture, inputs, lamp, settings, coarser), lamp.index + 1);
        if (plan.nodes <= most || coarser == coarsest) return plan;
    }
}

glm::mat4 direction_to_pixel(const Inputs& inputs, glm::vec2 pixels) {
    const glm::mat4 clip = inputs.projection * glm::mat4(glm::mat3(inputs.view));
    glm::mat4 to_pixel(0);
    for (int i = 0; i < 3; ++i) to_pixel[i] = {0.5F * pixels * (glm::vec2(clip[i]) + clip[i].w), clip[i].w, 0};
    return to_pixel;
}

std::vector<glm::vec4> EpipolarPlan::table() const {
    std::uint32_t count = 1;
    for (const EpipolarLines& light : lights) count = std::max(count, light.index + 1);
    std::vector<glm::vec4> texels(4 * std::size_t{count}, glm::vec4(0));
    for (const EpipolarLines& light : lights) {
        glm::vec4* texel = &texels[4 * std::size_t{light.index}];
        texel[0] = {light.axis, light.distance};
        texel[1] = {light.first, light.lines_per_radian};
        texel[2] = {light.cells_per_unit, light.lines, light.cells, light.nodes};
        texel[3] = {light.first_sample, light.samples_per_radian, light.samples, 0};
    }
    return texels;
}

}  // namespace tyndall::volumetrics
