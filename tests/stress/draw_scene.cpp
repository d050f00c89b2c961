#include "draw_scene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "support/test_scene.h"

namespace tyndall::stress {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

glm::mat4 draw_transform(glm::vec3 origin, Random& random) {
    glm::mat4 m = glm::translate(glm::mat4(1), origin);
    if (random.chance(0.6)) return m;
    m = glm::translate(m, random.box(3));
    const glm::vec3 axis = random.direction();
    m = glm::rotate(m, static_cast<float>(random.linear(0, 2 * pi)), axis);
    const glm::vec3 scale{logarithmic(random, 1e-2, 1e2), logarithmic(random, 1e-2, 1e2),
                          logarithmic(random, 1e-2, 1e2)};
    return glm::scale(m, random.chance(0.1) ? glm::vec3(0) : random.chance(0.1) ? -scale : scale);
}

void draw_camera(StressFrame& frame, bool comparable, glm::vec3 origin, const Random& of_sequence, Random& random) {
    Random still = of_sequence;
    Random& from = random.chance(0.5) ? random : still;  // a jump, or where the sequence stands
    glm::vec3 eye = origin + glm::vec3{from.linear(-8, 8), from.linear(0.1, 6), from.linear(-2, 12)};
    // Most cameras look at the objects.
    const glm::vec3 forward = from.chance(0.6) ? glm::normalize(origin + glm::vec3(0, 1.5f, -5) + from.box(2) - eye)
                                               : axis_or_direction(from);
    const double fov =
        comparable ? from.linear(20, 100) : from.pick({1.0, 170.0, from.linear(1, 170), from.linear(40, 90), 60.0});
    const float znear = comparable ? 0.1f : usual_or(from, 0.05, 0.5, 1e-3, 10);
    eye += random.box(0.05);
    const float aspect = static_cast<float>(frame.size.x) / static_cast<float>(frame.size.y);
    const glm::mat4 roll = glm::rotate(glm::mat4(1), static_cast<float>(from.linear(0, 2 * pi)), {0, 0, 1});
    frame.view = make_view(test::pose(eye, forward) * roll, static_cast<float>(fov) * pi / 180, znear, aspect);
}

}  // namespace

float logarithmic(Random& random, double low, double high) {
    return static_cast<float>(random.logarithmic(low, high));
}

float usual_or(Random& random, double usual_low, double usual_high, double low, double high) {
    return random.chance(0.55) ? logarithmic(random, usual_low, usual_high) : logarithmic(random, low, high);
}

glm::vec3 colour(Random& random) {
    if (random.chance(0.4)) return glm::vec3(1);
    const glm::vec3 c{random.unit(), random.unit(), random.unit()};
    return random.chance(0.3) ? glm::step(glm::vec3(0.5f), c) : c;
}

glm::vec3 axis_or_direction(Random& random) {
    if (!random.chance(0.3)) return random.direction();
    glm::vec3 axis(0);
    axis[random.below(3)] = random.chance(0.5) ? 1.0f : -1.0f;
    return axis;
}

glm::vec3 before_camera(const View& view, float distance) {
    return view.eye - distance * glm::vec3(view.view[0][2], view.view[1][2], view.view[2][2]);
}

void draw_world(StressFrame& frame, const Structure& structure, Random& of_sequence, Random& random) {
    // Objects that stand are prepared at the origin; all else may be far away.
    const bool movable = structure.world != World::standing && !structure.comparable;
    const glm::vec3 direction = of_sequence.direction();
    const glm::vec3 far = direction * logarithmic(of_sequence, 1, 1e6);
    const glm::vec3 origin = of_sequence.chance(0.4) && movable ? far : glm::vec3(0);

    if (structure.sun) frame.lights.push_back(draw_sun(structure, of_sequence));
    draw_camera(frame, structure.comparable, origin, of_sequence, random);
    if (structure.world == World::moving)
        for (int i = 0; i < 16; ++i)
            frame.objects.push_back(structure.comparable ? glm::mat4(1) : draw_transform(origin, random));
    draw_lamps(frame, structure, origin, random);
    draw_media(frame, structure, origin, random);
}

}  // namespace tyndall::stress
