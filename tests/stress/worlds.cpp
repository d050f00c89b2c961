#include "worlds.h"

#include "support/test_scene.h"

namespace tyndall::stress {
namespace {

// No glass: on both sides of it light has other colours, which neighbours of a pixel and other techniques find a
// texel apart; tests/gpu/glass_test.cpp and tests/image/reference_test.cpp compare it.
Scene furnished(bool dynamic) {
    test::SceneBuilder builder;
    const int white = builder.material(glm::vec3(1), 1);
    const int mirror = builder.material({0.9f, 0.6f, 0.2f}, 0, 1);
    const int shining = builder.material(glm::vec3(0), 0.3f, 0, {1e8f, 1e4f, 1e-4f});
    builder.ground({0, 0, 0}, 40);
    builder.box({-3, 1, -4}, {1, 1, 1}, white);
    builder.box({4, 2, -9}, {0.5f, 2, 3}, mirror);
    builder.box({0, 0.2f, -2}, {0.2f, 0.2f, 0.2f}, shining);
    for (int i = 0; i < 6; ++i) builder.box({static_cast<float>(i) - 2.5f, 2, -6}, {0.004f, 2, 0.004f}, white);
    builder.box({0, 6, 0}, {1e-4f, 1e3f, 1e-4f}, white);
    for (Node& node : builder.scene.nodes) node.dynamic = dynamic;
    return builder.finish();
}

}  // namespace

Worlds::Worlds(ShaderLibrary& shaders) : shaders_(shaders) {
    places_[static_cast<std::size_t>(World::nothing)].scene.materials.emplace_back();
    places_[static_cast<std::size_t>(World::standing)].scene = furnished(false);
    places_[static_cast<std::size_t>(World::moving)].scene = furnished(true);
}

Worlds::Place& Worlds::operator[](World world) {
    Place& place = places_[static_cast<std::size_t>(world)];
    if (!place.renderer) {
        place.volumetrics = std::make_unique<VolumetricsAdapter>();
        place.renderer = std::make_unique<Renderer>(shaders_, std::vector<FrameModule*>{place.volumetrics.get()});
        place.renderer->prepare(place.scene, 1);
    }
    return place;
}

}  // namespace tyndall::stress
