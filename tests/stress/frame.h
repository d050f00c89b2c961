#pragma once

#include <string>
#include <vector>

#include "engine/render/renderer.h"
#include "worlds.h"

namespace tyndall::stress {

/// Frames come in sequences that share size, resources and kind of scene, with a camera that moves or jumps.
constexpr int sequence_length = 4;

/// What stands between the samples of a comparable frame and its picture; plain: nothing.
enum class Feature { plain, filter, history, low_resolution };

struct StressOptions : FrameOptions {
    volumetrics::Settings volumetrics;
};

/// One frame: a pure function of seed and number.
struct StressFrame {
    World world = World::nothing;
    std::vector<glm::mat4> objects;  ///< of World::moving: what multiplies each node's own transform
    struct Lamp {
        Light light;
        glm::mat4 pose;
    };
    std::vector<Lamp> lights;
    std::vector<Medium> media;
    float exposure_ev100 = 0;
    View view;
    glm::ivec2 size{1};
    StressOptions options;
    bool cut = false;         ///< a camera jump that the renderer is told of
    bool comparable = false;  ///< within what a truth follows: see moderate.h
    Feature feature = Feature::plain;
};
[[nodiscard]] StressFrame make_frame(std::uint64_t seed, int number);

/// `scene` is the world's; gets the frame's objects, lights and media.
[[nodiscard]] Scene pose_scene(const Scene& world, const StressFrame& frame);

}  // namespace tyndall::stress
