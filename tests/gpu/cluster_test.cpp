#include "engine/render/passes/cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "engine/core/files.h"
#include "engine/render/passes/depth_pyramid.h"
#include "shaders/engine/visible_lights.h"
#include "shaders/shared/bindings.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

constexpr glm::ivec2 size(160, 90);

bool lights_point(const shared::GpuLight& light, glm::vec3 point) {
    const glm::vec3 to = point - glm::vec3(light.position_range);
    const float d = glm::length(to);
    if (d >= 0.9999f * light.position_range.w) return false;
    if (light.direction_type.w == LIGHT_POINT) return true;
    const float cosine = glm::dot(to, glm::vec3(light.direction_type)) / d;
    return cosine * light.cone_shadow.x + light.cone_shadow.y > 1e-4f;
}

class Cluster : public GlTest {
  protected:
    struct Lists {
        shared::VisibleLightsHeader header{};
        std::vector<shared::ClusterRange> ranges;
        std::vector<std::uint32_t> pool;
        std::size_t bound = 0;
        [[nodiscard]] std::vector<std::uint32_t> of(std::size_t cluster) const {
            const auto first = pool.begin() + ranges[cluster].offset;
            return {first, first + ranges[cluster].count};
        }
    };

    Cluster() { builder_.ground({0, -100, 0}, 1); }

    void random_lamps(int count, float half_extent, float max_range) {
        std::uniform_real_distribution<float> unit(-1, 1);
        const auto in_box = [&] {
            return half_extent * glm::vec3(unit(random_), 0.3f * unit(random_), unit(random_));
        };
        for (int i = 0; i < count; ++i) {
            const float range = max_range * (0.55f + 0.45f * unit(random_));
            if (i % 2 == 0)
                builder_.point(in_box(), glm::vec3(1), range);
            else
                builder_.spot(in_box(), {unit(random_), unit(random_), unit(random_) + 1.5f}, glm::vec3(1), range,
                              0.8f + 0.7f * unit(random_));
        }
    }

    /// `depth` of every pixel (rows from the bottom); empty: no occlusion test.
    Lists run(const std::vector<float>& depth = {}) {
        Scene& scene = builder_.finish();
        GpuScene gpu(scene);
        const FrameFacts facts;
        PassList passes;
        frame_ = {};
        frame_.view = view_.view;
        frame_.projection = view_.projection;
        frame_.viewport = {size, 1.0f / glm::vec2(size)};
        lights_.update(scene, find_lamps(scene, Frustum::from(view_.view_projection)));
        lights_.upload();
        set_cluster_grid(frame_, settings_, view_.znear, lights_.lights().size());
        FrameContext context{scene, gpu, view_, facts, settings_, shaders_, passes, frame_, size};
        const gl::Buffer block = gl::Buffer::of(std::span<const shared::FrameData>(&frame_, 1), "test frame");
        block.bind(GL_UNIFORM_BUFFER, BINDING_FRAME);

        gl::Texture source;
        TextureRef pyramid;
        if (!depth.empty()) {
            source = gl::Texture({gl::TextureKind::d2, GL_DEPTH_COMPONENT32F, {size, 1}, 1}, "test depth");
            source.upload(0, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
            pyramid = add_depth_pyramid(context, passes.import("depth", source));
        }
        const ClusterPass::Output output = cluster_.add(context, lights_, pyramid);
        passes.export_buffer(output.lights);
        passes.compile();
        TransientPool pool;
        passes.execute(pool);

        Lists lists;
        lists.bound = cluster_list_bound(frame_, lights_.lights());
        cluster_.visible().read(0, sizeof lists.header, &lists.header);
        lists.ranges.resize(frame_.cluster_size.x * frame_.cluster_size.y * frame_.cluster_size.z);
        cluster_.ranges().read(0, lists.ranges.size() * sizeof(shared::ClusterRange), lists.ranges.data());
        lists.pool.resize(lists.header.pool_used);
        cluster_.pool().read(0, lists.pool.size() * sizeof(std::uint32_t), lists.pool.data());
        return lists;
    }

    /// Where a point in view lies, from the definition of the grid: screen tiles, equal ratios of view depth
    /// between 1 m and cluster_far, first and last slice open.
    [[nodiscard]] std::size_t cluster_of(glm::vec2 uv, double view_depth) const {
        const double slice = settings_.cluster_z * std::log(view_depth) / std::log(double{settings_.cluster_far});
        const auto z = static_cast<std::size_t>(std::clamp(slice, 0.0, settings_.cluster_z - 1.0));
        const auto x = static_cast<std::size_t>(uv.x * static_cast<float>(settings_.cluster_x));
        const auto y = static_cast<std::size_t>(uv.y * static_cast<float>(settings_.cluster_y));
        return x + settings_.cluster_x * (y + settings_.cluster_y * z);
    }
    [[nodiscard]] glm::vec3 world(glm::vec2 uv, float view_depth) const {
        const glm::vec2 tangents(1 / view_.projection[0][0], 1 / view_.projection[1][1]);
        const glm::vec3 in_view((uv * 2.0f - 1.0f) * tangents * view_depth, -view_depth);
        return glm::vec3(glm::inverse(view_.view) * glm::vec4(in_view, 1));
    }
    void expect_complete(const Lists& lists, int points) {
        std::uniform_real_distribution<float> unit(0, 1);
        int lit = 0;
        for (int i = 0; i < points; ++i) {
            const glm::vec2 uv(unit(random_), unit(random_));
            const float depth = 0.1f * std::pow(4000.0f, unit(random_));
            const glm::vec3 point = world(uv, depth);
            const auto list = lists.of(cluster_of(uv, depth));
            for (std::uint32_t k = 0; k < lights_.lights().size(); ++k) {
                if (!lights_point(lights_.lights()[k], point)) continue;
                ++lit;
                EXPECT_TRUE(std::ranges::binary_search(list, k)) << "lamp " << k << " at depth " << depth;
            }
        }
        EXPECT_GT(lit, points / 4) << "the scene lights too few points to test anything";
    }

    std::mt19937 random_{17};
    test::SceneBuilder builder_;
    View view_ = look_at({0, 1, 30}, {0, 0, 0}, 1.0f, 0.1f, 16.0f / 9.0f);
    RenderSettings settings_;
    shared::FrameData frame_{};
    LightSet lights_;
    ClusterPass cluster_;
    ShaderLibrary& shaders_ = shared_shaders();
};

TEST_F(Cluster, EveryLampThatLightsAPointIsInItsListAndInOrder) {
    random_lamps(400, 40, 12);
    const Lists lists = run();
    expect_complete(lists, 3000);
    for (std::size_t c = 0; c < lists.ranges.size(); ++c) {
        const auto list = lists.of(c);
        EXPECT_TRUE(std::ranges::is_sorted(list)) << c;
    }
}

TEST_F(Cluster, HoldsFourThousandLampsWithinTheBoundOfItsPool) {
    random_lamps(4096, 60, 4);
    const Lists lists = run();
    EXPECT_GT(lists.header.count, 1000u);
    EXPECT_LE(lists.header.count, 4096u);
    EXPECT_LE(lists.header.pool_used, lists.bound);
    EXPECT_GE(cluster_.pool().size(), lists.bound * sizeof(std::uint32_t));
    expect_complete(lists, 400);
}

TEST_F(Cluster, WorstCaseOfLampsThatReachEverywhereDoesNotOverflow) {
    random_lamps(300, 5, 2000);
    const Lists lists = run();
    EXPECT_LE(lists.header.pool_used, lists.bound);
    expect_complete(lists, 200);
}

TEST_F(Cluster, ListsAreTheSameEveryTime) {
    random_lamps(500, 30, 8);
    const Lists a = run(), b = run();
    for (std::size_t c = 0; c < a.ranges.size(); ++c) EXPECT_EQ(a.of(c), b.of(c)) << c;
}

TEST_F(Cluster, ListsHoldFewLampsThatDoNotReachTheirCluster) {
    random_lamps(300, 30, 8);
    const Lists lists = run();
    // What belongs there, by points on a grid in each cluster between 1 m and cluster_far.
    std::size_t needed = 0, listed = 0;
    constexpr int n = 6;
    for (int z = 0; z + 1 < settings_.cluster_z; ++z)
        for (int y = 0; y < settings_.cluster_y; ++y)
            for (int x = 0; x < settings_.cluster_x; ++x) {
                const auto c = static_cast<std::size_t>(x + settings_.cluster_x * (y + settings_.cluster_y * z));
                const auto list = lists.of(c);
                listed += list.size();
                for (const std::uint32_t k : list) {
                    bool reached = false;
                    for (int i = 0; i < n * n * n && !reached; ++i) {
                        const glm::vec3 f = glm::vec3(i % n, i / n % n, i / n / n) / static_cast<float>(n - 1);
                        const glm::vec2 uv((static_cast<float>(x) + f.x) / static_cast<float>(settings_.cluster_x),
                                           (static_cast<float>(y) + f.y) / static_cast<float>(settings_.cluster_y));
                        const float slice = (static_cast<float>(z) + f.z) / static_cast<float>(settings_.cluster_z);
                        const float depth = z == 0 && f.z == 0 ? 0.1f : std::pow(settings_.cluster_far, slice);
                        reached = lights_point(lights_.lights()[k], world(uv, depth));
                    }
                    needed += reached ? 1 : 0;
                }
            }
    EXPECT_GT(needed, 1000u);
    EXPECT_LT(static_cast<double>(listed), 1.6 * static_cast<double>(needed));
}

TEST_F(Cluster, LampsBehindAWallAreLeftOutThoseBesideItAreNot) {
    builder_.point({0, 0, 0}, glm::vec3(1), 2);   // 30 m away, behind the wall
    builder_.point({0, 0, 25}, glm::vec3(1), 2);  // before it
    builder_.point({0, 0, 19}, glm::vec3(1), 2);  // its reach pierces the wall
    builder_.point({13, 0, 0}, glm::vec3(1), 2);  // behind, but where the wall has a hole
    // A wall at 10 m over all of the screen but its right third.
    std::vector<float> depth;
    for (int i = 0; i < size.x * size.y; ++i) depth.push_back(i % size.x < size.x * 2 / 3 ? 0.1f / 10 : 0.0f);
    const Lists lists = run(depth);
    EXPECT_EQ(lists.header.count, 3u);
    EXPECT_EQ(lists.header.occluded, 1u);
    std::set<std::uint32_t> listed;
    for (std::size_t c = 0; c < lists.ranges.size(); ++c)
        for (const std::uint32_t lamp : lists.of(c)) listed.insert(lamp);
    EXPECT_EQ(listed, (std::set<std::uint32_t>{1, 2, 3}));
}

TEST_F(Cluster, OddGridsAndALastSliceThatHoldsAllTheRest) {
    settings_.cluster_x = 7;
    settings_.cluster_y = 5;
    settings_.cluster_z = 3;
    settings_.cluster_far = 20;
    random_lamps(200, 60, 15);
    expect_complete(run(), 2000);
    settings_.cluster_x = settings_.cluster_y = settings_.cluster_z = 1;
    expect_complete(run(), 500);
}

}  // namespace
}  // namespace tyndall
