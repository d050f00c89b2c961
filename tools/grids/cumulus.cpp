#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/grids/models.h"
#include "tools/grids/noise3.h"
#include "tools/modeling/random.h"

namespace tyndall::grid_models {
namespace {

using modeling::Random;

struct Puff {
    glm::vec3 center;
    float radius;
};

float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

/// A column of puffs that grow smaller upwards.
void add_tower(std::vector<Puff>& puffs, glm::vec2 foot, float height, float radius, Random& random) {
    for (float y = 34; y < height + 35; y += 0.55F * radius)
        puffs.push_back({{foot.x + random.range(-14, 14), y, foot.y + random.range(-14, 14)},
                         radius * (1 - 0.35F * y / (height + 60))});
}

/// Towers on a common base: a few high ones, and low ones that join and surround them.
std::vector<Puff> towers(Random& random) {
    std::vector<Puff> puffs;
    add_tower(puffs, {-40, 10}, 195, 66, random);
    add_tower(puffs, {75, -45}, 150, 60, random);
    add_tower(puffs, {-130, 55}, 120, 55, random);
    add_tower(puffs, {150, 60}, 105, 50, random);
    add_tower(puffs, {20, 95}, 125, 52, random);
    add_tower(puffs, {-95, -75}, 95, 50, random);
    for (int i = 0; i < 26; ++i) {
        const float angle = random.range(0, 2 * modeling::kPi), out = std::sqrt(random.unit());
        add_tower(puffs, {230 * out * modeling::cosine(angle), 175 * out * modeling::sine(angle)},
                  random.range(5, 60) * (1.2F - out), random.range(40, 54) * (1 - 0.3F * out), random);
    }
    return puffs;
}

/// Smaller puffs on the upper side of each, spread by the golden angle: the heads of a cauliflower.
std::vector<Puff> heads(const std::vector<Puff>& on, int count, float share, Random& random) {
    constexpr float golden_angle = 2.399963F;
    std::vector<Puff> puffs;
    for (const Puff& puff : on) {
        const float turn = random.range(0, 2 * modeling::kPi);
        for (int i = 0; i < count; ++i) {
            const float up = 1 - 1.35F * (float(i) + random.unit()) / float(count);
            const float level = std::sqrt(std::max(0.0F, 1 - up * up));
            const float angle = turn + golden_angle * float(i) + random.range(-0.3F, 0.3F);
            const glm::vec3 direction(level * modeling::cosine(angle), up, level * modeling::sine(angle));
            const float radius = puff.radius * share * random.range(0.7F, 1.25F);
            puffs.push_back({puff.center + (puff.radius - 0.35F * radius) * direction, radius});
        }
    }
    return puffs;
}

std::vector<Puff> make_puffs() {
    Random random(2002);
    std::vector<Puff> all = towers(random);
    const std::vector<Puff> large = heads(all, 9, 0.5F, random), small = heads(large, 6, 0.45F, random);
    all.insert(all.end(), large.begin(), large.end());
    all.insert(all.end(), small.begin(), small.end());
    return all;
}

constexpr float reach = 24;  ///< m: farther from all puffs there is nothing

/// Metres below the surface of the puffs, at most -reach outside of them.
float depth_below(const std::vector<Puff>& puffs, const glm::vec3& p) {
    float deepest = -reach;
    for (const Puff& puff : puffs) {
        const glm::vec3 away = p - puff.center;
        const float squared = away.x * away.x + away.y * away.y + away.z * away.z;
        const float farthest = puff.radius - deepest;
        if (squared < farthest * farthest) deepest = puff.radius - std::sqrt(squared);
    }
    return deepest;
}

float density_at(const std::vector<Puff>& puffs, const glm::vec3& p) {
    const glm::vec3 warped = p + 9.0F * glm::vec3(fractal_noise(p / 55.0F, 2, 11), fractal_noise(p / 55.0F, 2, 21),
                                                  fractal_noise(p / 55.0F, 2, 31));
    float depth = depth_below(puffs, warped);
    if (depth <= -reach) return 0;
    depth += 15 * (billows(warped / 34.0F, 41) - 0.5F) + 8 * (billows(warped / 15.0F, 42) - 0.45F);
    depth += 3.5F * fractal_noise(p / 15.0F, 3, 51);
    // The base: level where the air reaches its dew point, and frayed.
    const float above_base = p.y - 8 - 9 * fractal_noise({p.x / 60, 0, p.z / 60}, 3, 61);
    depth = std::min(depth, above_base);
    const float frayed = smooth_step(70, 0, p.y);
    depth -= frayed * 10 * std::max(0.0F, fractal_noise(p / 26.0F, 3, 71) + 0.1F);
    if (depth <= 0) return 0;
    const float edge = smooth_step(0, 11, depth), core = smooth_step(0, 45, depth);
    const float patches = 0.92F + 0.16F * fractal_noise(p / 45.0F, 2, 81);
    return std::clamp(edge * (0.6F + 0.4F * core) * patches, 0.0F, 1.0F);
}

}  // namespace

Voxels make_cumulus() {
    Voxels voxels({160, 80, 128}, 4, {-318, 2, -254});
    const std::vector<Puff> all = make_puffs();
    constexpr int block = 8;
    for (int bz = 0; bz < voxels.size.z; bz += block)
        for (int by = 0; by < voxels.size.y; by += block)
            for (int bx = 0; bx < voxels.size.x; bx += block) {
                const glm::vec3 middle =
                    voxels.first_voxel + voxels.voxel_size * (glm::vec3(bx, by, bz) + 0.5F * (block - 1));
                const float half_diagonal = 0.87F * block * voxels.voxel_size, most_warp = 30;
                std::vector<Puff> near;
                for (const Puff& puff : all)
                    if (glm::distance(puff.center, middle) < puff.radius + reach + half_diagonal + most_warp)
                        near.push_back(puff);
                if (near.empty()) continue;
                for (int z = bz; z < bz + block; ++z)
                    for (int y = by; y < by + block; ++y)
                        for (int x = bx; x < bx + block; ++x)
                            voxels.at(x, y, z) =
                                density_at(near, voxels.first_voxel + voxels.voxel_size * glm::vec3(x, y, z));
            }
    return voxels;
}

}  // namespace tyndall::grid_models
