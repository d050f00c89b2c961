#pragma once

#include "frame.h"
#include "random.h"

namespace tyndall::stress {

/// small: each side up to 128; thumbnail: 9 to 33, of comparable frames.
enum class SizeKind { small, thumbnail, one_pixel, column, row, wide, tall };

/// What decides the shader permutations of a frame.
struct Structure {
    bool comparable = false;
    World world = World::nothing;
    SizeKind size = SizeKind::small;
    bool sun = false, lamps = false;
    bool homogeneous = false;
    int heights = 0;
    bool local = false, local_emission = false;
    bool chromatic = false;
    StressOptions options;
};

/// Camera, objects, lights and media. The sun comes from `of_sequence`: a new one costs a new sky.
void draw_world(StressFrame& frame, const Structure& structure, Random& of_sequence, Random& random);

// Its parts; `origin` is where the objects stand.
[[nodiscard]] StressFrame::Lamp draw_sun(const Structure& structure, Random& random);
void draw_lamps(StressFrame& frame, const Structure& structure, glm::vec3 origin, Random& random);
void draw_media(StressFrame& frame, const Structure& structure, glm::vec3 origin, Random& random);

[[nodiscard]] float logarithmic(Random& random, double low, double high);
/// Half of the time something usual, else anything: a frame in which all is extreme shows nothing.
[[nodiscard]] float usual_or(Random& random, double usual_low, double usual_high, double low, double high);
[[nodiscard]] glm::vec3 colour(Random& random);  ///< channels 0 … 1; sometimes black or a primary
[[nodiscard]] glm::vec3 axis_or_direction(Random& random);
[[nodiscard]] glm::vec3 before_camera(const View& view, float distance);

}  // namespace tyndall::stress
