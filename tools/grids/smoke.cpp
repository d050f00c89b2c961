#include <algorithm>
#include <cmath>

#include "tools/grids/fluid.h"
#include "tools/grids/models.h"
#include "tools/grids/noise3.h"

namespace tyndall::grid_models {
namespace {

constexpr glm::ivec3 cells(44, 64, 44);
constexpr float cell_size = 0.05F;  ///< m
constexpr float seconds_a_step = 1.0F / 30;
constexpr int steps = 130;

/// Embers on the floor: smoke and heat, in patches that wander.
void feed(Fluid& fluid, float time) {
    constexpr float radius = 5;  // cells
    for (int z = 0; z < cells.z; ++z)
        for (int x = 0; x < cells.x; ++x)
            for (int y = 0; y < 3; ++y) {
                const float dx = float(x) - 0.5F * (cells.x - 1), dz = float(z) - 0.5F * (cells.z - 1);
                const float inside = 1 - std::sqrt(dx * dx + dz * dz) / radius;
                if (inside <= 0) continue;
                const float patch =
                    std::clamp(0.75F + 0.8F * fractal_noise({dx / 4, 1.7F * time, dz / 4}, 2, 5), 0.0F, 1.0F);
                fluid.smoke.at(x, y, z) = std::max(fluid.smoke.at(x, y, z), patch * std::min(1.0F, 2.5F * inside));
                fluid.heat.at(x, y, z) = std::max(fluid.heat.at(x, y, z), patch);
            }
}

/// Draughts, in cells and seconds.
void disturb(Fluid& fluid, float time) {
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const glm::vec3 p = glm::vec3(x, y, z) / 14.0F + glm::vec3(0, -0.6F * time, 0.35F * time);
                fluid.push(
                    x, y, z,
                    8.0F * glm::vec3(gradient_noise(p, 7), 0.3F * gradient_noise(p, 8), gradient_noise(p, 9)));
            }
}

/// Down to 0 at all sides of the box but the floor.
float fade_at(int x, int y, int z) {
    const int rim = std::min({x, z, cells.x - 1 - x, cells.z - 1 - z, cells.y - 1 - y});
    return std::clamp(float(rim) / 6, 0.0F, 1.0F);
}

}  // namespace

Voxels make_smoke() {
    Fluid fluid(cells);
    for (int i = 0; i < steps; ++i) {
        const float time = float(i) * seconds_a_step;
        feed(fluid, time);
        disturb(fluid, time);
        for (float& heat : fluid.heat.values) heat *= 0.98F;
        for (float& smoke : fluid.smoke.values) smoke *= 0.997F;
        fluid.step(seconds_a_step, 90, 6);
    }
    Voxels voxels(cells, cell_size,
                  {-0.5F * cell_size * (cells.x - 1), 0.5F * cell_size, -0.5F * cell_size * (cells.z - 1)});
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const float smoke = fluid.smoke.at(x, y, z) * fade_at(x, y, z);
                voxels.at(x, y, z) = std::clamp((smoke - 0.004F) / 0.996F, 0.0F, 1.0F);
            }
    return voxels;
}

}  // namespace tyndall::grid_models
