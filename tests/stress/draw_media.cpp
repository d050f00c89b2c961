#include <algorithm>
#include <numbers>

#include "draw_scene.h"

namespace tyndall::stress {
namespace {

/// Scattering and absorption: sigma_t 0, 1e-8 … 1e4; albedo 0, 1, anything. The first medium of a frame holds what
/// the structure promises: it is there, coloured, and shines.
void draw_coefficients(Medium& medium, bool first, bool emission, const Structure& structure, Random& random) {
    const bool comparable = structure.comparable;
    float sigma_t = comparable ? logarithmic(random, 1e-4, 0.3) : usual_or(random, 1e-4, 0.3, 1e-8, 1e4);
    if (!comparable && !first && random.chance(0.15)) sigma_t = 0;
    const glm::vec3 tint = structure.chromatic ? glm::vec3{random.linear(0, 0.9), 1, random.unit()} : glm::vec3(1);
    const auto albedo =
        static_cast<float>(random.pick({0.0, 1.0, 1.0, random.unit(), random.unit(), random.unit()}));
    medium.sigma_s = sigma_t * albedo * tint;
    medium.sigma_a = sigma_t * (1 - albedo) * tint;
    medium.anisotropy = static_cast<float>(comparable ? random.linear(-0.6, 0.6)
                                                      : random.pick({0.0, 0.999, -0.999, random.linear(-1, 1)}));
    medium.anisotropy = std::clamp(medium.anisotropy, -0.999f, 0.999f);
    if (emission && (first || random.chance(0.5))) {
        medium.emission = colour(random);
        medium.emission *= comparable ? logarithmic(random, 1e-3, 10) : usual_or(random, 1e-2, 100, 1e-6, 1e6);
    }
}

Medium draw_global(bool height, const StressFrame& frame, const Structure& structure, glm::vec3 origin,
                   Random& random) {
    const bool comparable = structure.comparable;
    Medium medium;
    medium.shape = height ? Medium::Shape::height : Medium::Shape::global;
    draw_coefficients(medium, frame.media.empty(), random.chance(0.3), structure, random);
    medium.rayleigh = random.fork("air").chance(0.2);
    if (!height) return medium;
    medium.height_profile = true;
    medium.falloff = comparable ? logarithmic(random, 3, 50) : usual_or(random, 1, 50, 1e-3, 1e5);
    const double sign = random.pick({-1.0, 1.0});
    const double above = comparable ? random.linear(-5, 10) : sign * random.logarithmic(1e-3, 1e4);
    medium.base = origin.y + static_cast<float>(above);
    return medium;
}

/// Also lengths that no file may have: 0 and less.
float draw_length(Random& random) {
    if (random.chance(0.06)) return 0;
    const float sign = random.chance(0.06) ? -1.0f : 1.0f;
    return sign * usual_or(random, 0.5, 20, 1e-3, 1e3);
}

/// Two lumps that share no brick, one of them along bricks' borders.
const std::shared_ptr<const DensityGrid>& lumps() {
    static const auto made = [] {
        auto grid = std::make_shared<DensityGrid>();
        grid->bricks = {{-8, 0, 0}, {0, 0, 0}, {24, 8, -16}};
        Random random{1};
        for (std::size_t i = 0; i < grid->bricks.size() * DensityGrid::brick_size; ++i)
            grid->values.push_back(random.chance(0.4) ? static_cast<float>(random.unit()) : 0.0F);
        grid->lower = {-8, 0, -16};
        grid->upper = {31, 15, 7};
        grid->greatest = *std::ranges::max_element(grid->values);
        return std::shared_ptr<const DensityGrid>(grid);
    }();
    return made;
}

void make_grid(Medium& medium, Random random) {
    medium.shape = Medium::Shape::grid;
    medium.grid = lumps();
    medium.scale = usual_or(random, 0.03, 1, 1e-4, 1e3);
    medium.density = usual_or(random, 0.1, 10, 1e-6, 1e4);
    medium.nearest = random.chance(0.5);
}

Medium draw_extreme_local(bool first, const StressFrame& frame, const Structure& structure, glm::vec3 origin,
                          Random& random) {
    Medium medium;
    medium.shape = random.pick({Medium::Shape::sphere, Medium::Shape::ellipsoid, Medium::Shape::box});
    draw_coefficients(medium, first, structure.local_emission, structure, random);
    medium.center = random.chance(0.2) ? frame.view.eye : origin + random.box(20);
    const float radius = draw_length(random);
    const glm::vec3 extent{draw_length(random), draw_length(random), draw_length(random)};
    medium.half_extent = medium.shape == Medium::Shape::sphere ? glm::vec3(radius) : extent;
    if (first) {  // in view
        medium.center = before_camera(frame.view, logarithmic(random, 1, 10));
        medium.half_extent = glm::abs(medium.half_extent) + 0.1f;
    }
    if (medium.shape == Medium::Shape::box) medium.half_extent *= 0.5f;
    medium.rotation =
        glm::angleAxis(static_cast<float>(random.linear(0, 2 * std::numbers::pi)), random.direction());
    medium.softness = random.chance(0.4) ? 0 : usual_or(random, 0.1, 5, 1e-4, 1e4);
    if (random.chance(0.5)) {
        medium.noise_scale = usual_or(random, 0.1, 5, 1e-6, 1e3);
        medium.noise_amount = static_cast<float>(random.pick({1.0, random.unit()}));
        medium.noise_seed = random.below(1 << 30);
    }
    medium.height_profile = random.chance(0.3);
    medium.falloff = usual_or(random, 0.5, 20, 1e-3, 1e4);
    medium.base = origin.y + static_cast<float>(random.linear(-100, 100));
    constexpr int most_grids = 8;
    if (random.fork("is grid").chance(0.04) &&
        std::ranges::count(frame.media, Medium::Shape::grid, &Medium::shape) < most_grids)
        make_grid(medium, random.fork("grid"));
    return medium;
}

/// Of a metre or more, and not so dense that what lies behind is unseen.
Medium draw_comparable_local(bool first, const StressFrame& frame, const Structure& structure, glm::vec3 origin,
                             Random& random) {
    Medium medium;
    medium.shape = random.pick({Medium::Shape::sphere, Medium::Shape::ellipsoid, Medium::Shape::box});
    draw_coefficients(medium, first, structure.local_emission, structure, random);
    const glm::vec3 sigma_t = medium.sigma_s + medium.sigma_a;
    const float density = logarithmic(random, 0.01, 0.15) / std::max({sigma_t.x, sigma_t.y, sigma_t.z});
    for (glm::vec3* coefficient : {&medium.sigma_s, &medium.sigma_a}) *coefficient *= density;
    medium.center = random.chance(0.2) ? frame.view.eye : before_camera(frame.view, logarithmic(random, 2, 15));
    if (!first) medium.center = origin + random.box(8);
    const auto length = [&] { return logarithmic(random, 1, 6); };
    medium.half_extent =
        medium.shape == Medium::Shape::sphere ? glm::vec3(length()) : glm::vec3{length(), length(), length()};
    if (medium.shape == Medium::Shape::box) medium.half_extent *= 0.5f;
    medium.rotation =
        glm::angleAxis(static_cast<float>(random.linear(0, 2 * std::numbers::pi)), random.direction());
    medium.softness = random.chance(0.5) ? 0 : logarithmic(random, 0.3, 2);
    if (random.chance(0.3)) {
        medium.noise_scale = logarithmic(random, 2, 6);
        medium.noise_amount = static_cast<float>(random.unit());
        medium.noise_seed = random.below(1 << 24);  // shaders get it as a float, which rounds larger ones
    }
    medium.height_profile = random.chance(0.3);
    medium.falloff = logarithmic(random, 3, 50);
    medium.base = medium.center.y + static_cast<float>(random.linear(-3, 3));
    return medium;
}

Medium draw_local(bool first, const StressFrame& frame, const Structure& structure, glm::vec3 origin,
                  Random& random) {
    return structure.comparable ? draw_comparable_local(first, frame, structure, origin, random)
                                : draw_extreme_local(first, frame, structure, origin, random);
}

}  // namespace

void draw_media(StressFrame& frame, const Structure& structure, glm::vec3 origin, Random& random) {
    const int most = structure.comparable ? 2 : random.chance(0.05) ? 40 : 4;
    const int local = structure.local ? 1 + random.below(most) : 0;
    for (int i = 0; i < local; ++i) frame.media.push_back(draw_local(i == 0, frame, structure, origin, random));
    if (structure.homogeneous) frame.media.push_back(draw_global(false, frame, structure, origin, random));
    for (int i = 0; i < structure.heights; ++i)
        frame.media.push_back(draw_global(true, frame, structure, origin, random));
}

}  // namespace tyndall::stress
