#include "engine/scene/particles.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<Particle> at(const ParticleEmitter& emitter, double time, const glm::mat4& world = glm::mat4(1)) {
    std::vector<Particle> particles;
    append_particles(emitter, world, time, particles);
    return particles;
}

TEST(Particles, FollowTheirParabola) {
    ParticleEmitter e;
    e.count = 1;
    e.lifetime = 4;
    e.size = 0.5f;
    e.growth = 0.25f;
    e.velocity = {1, 2, 0};
    e.acceleration = {0, 0, -2};
    e.spread = 0;
    e.opacity = 0.8f;
    e.emission = glm::vec3(100);
    glm::mat4 world(1);
    world[3] = {10, 20, 30, 1};
    for (const double time : {1.0, 5.0, -3.0, 4e6 + 1}) {  // each 1 s after a birth
        const Particle p = at(e, time, world).at(0);
        EXPECT_NEAR(glm::distance(p.position, glm::vec3(11, 22, 29)), 0, 1e-4) << time;
        EXPECT_NEAR(p.radius, 0.75, 1e-5);
        EXPECT_NEAR(p.opacity, 0.8 * 4 * 0.25 * 0.75, 1e-5);
        EXPECT_NEAR(p.emission.x, 75, 1e-2);
    }
}

TEST(Particles, AreBornEvenlyInTime) {
    ParticleEmitter e;
    e.count = 8;
    e.lifetime = 2;
    e.velocity = {0, 1, 0};
    e.spread = 0;
    std::vector<float> ages;
    for (const Particle& p : at(e, 0.1)) ages.push_back(p.position.y);
    std::ranges::sort(ages);
    ASSERT_EQ(ages.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(ages[i], 0.1 + 0.25 * static_cast<double>(i), 1e-5);
}

TEST(Particles, MoveContinuouslyAndDifferFromBirthToBirth) {
    ParticleEmitter e;
    e.count = 50;
    e.lifetime = 3;
    e.extent = {1, 0, 1};
    e.seed = 5;
    const auto a = at(e, 7.0), b = at(e, 7.001), next_life = at(e, 10.0);
    int again = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const float moved = glm::distance(a[i].position, b[i].position);
        EXPECT_TRUE(moved < 0.002f || b[i].random != a[i].random) << i << " moved " << moved;
        EXPECT_LE(glm::length(glm::vec2(a[i].position.x, a[i].position.z)), 1 + 3 * 0.1f + 1e-4f);
        again += next_life[i].random == a[i].random;
    }
    EXPECT_LE(again, 1);
    e.seed = 6;
    EXPECT_NE(at(e, 7.0)[0].position, a[0].position);
}

TEST(Particles, StayWithinTheirSpread) {
    // A ball of velocities of radius s: mean 0, root mean square s sqrt(3 / 5).
    ParticleEmitter e;
    e.count = 4000;
    e.lifetime = 1;
    e.velocity = glm::vec3(0);
    e.spread = 2;
    glm::dvec3 mean(0);
    double square = 0;
    for (int i = 0; i < e.count; ++i) {
        ParticleEmitter one = e;
        one.count = 1;
        one.seed = i;
        const glm::dvec3 v = at(one, 0.5).at(0).position * 2.0f;
        EXPECT_LE(glm::length(v), 2 + 1e-4);
        mean += v / 4000.0;
        square += glm::dot(v, v) / 4000.0;
    }
    EXPECT_LT(glm::length(mean), 0.1);
    EXPECT_NEAR(std::sqrt(square), 2 * std::sqrt(0.6), 0.03);
}

class ParticleFile : public SceneFolderTest {
  protected:
    [[nodiscard]] Scene load_extras(const json& particles) const {
        GltfBuilder b;
        b.triangle();
        b.node({{"name", "smoke"}, {"extras", {{"particles", particles}}}});
        return load(b);
    }
};

TEST_F(ParticleFile, IsRead) {
    const Scene scene = load_extras({{"count", 12},
                                     {"lifetime", 5},
                                     {"size", 0.3},
                                     {"velocity", {0, 1, 0}},
                                     {"color", {0.1, 0.2, 0.3}},
                                     {"opacity", 0.4},
                                     {"seed", 9}});
    ASSERT_EQ(scene.emitters.size(), 1u);
    const ParticleEmitter& e = scene.emitters[0];
    EXPECT_EQ(scene.nodes.at(static_cast<std::size_t>(e.node)).name, "smoke");
    EXPECT_EQ(e.count, 12);
    EXPECT_EQ(e.lifetime, 5);
    EXPECT_EQ(e.size, 0.3f);
    EXPECT_EQ(e.velocity, glm::vec3(0, 1, 0));
    EXPECT_EQ(e.color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(e.opacity, 0.4f);
    EXPECT_EQ(e.seed, 9);
    EXPECT_EQ(e.spread, ParticleEmitter().spread);
}

TEST_F(ParticleFile, BadValuesAreErrorsThatNameThem) {
    const std::pair<json, const char*> bad[] = {
        {3, "extras.particles: an object expected"},
        {{{"speed", 1}}, "extras.particles.speed: not known"},
        {{{"count", 0}}, "extras.particles.count: 0 given, a whole number from 1 to 4096 expected"},
        {{{"count", 1.5}}, "count: 1.5 given"},
        {{{"count", 1e30}}, "count: "},
        {{{"lifetime", 0}}, "extras.particles.lifetime: 0 given, a number from 0.01 to 10000 expected"},
        {{{"size", -1}}, "size: -1 given"},
        {{{"size", "big"}}, "size: \"big\" given"},
        {{{"velocity", {1, 2}}}, "extras.particles.velocity: [1,2] given, three numbers expected"},
        {{{"velocity", {1, 2, nullptr}}}, "velocity: null given"},
        {{{"color", {0, 0, 1.5}}}, "color: 1.5 given, a number from 0 to 1 expected"},
        {{{"opacity", 2}}, "opacity: 2 given"},
        {{{"emission", {0, 0, -1}}}, "emission: -1 given"},
    };
    for (const auto& [value, message] : bad)
        EXPECT_THAT([&] { (void)load_extras(value); }, ThrowsMessage<Error>(HasSubstr(message))) << value;
}

}  // namespace
}  // namespace tyndall
