#include <numbers>

#include "draw_scene.h"
#include "support/test_scene.h"

namespace tyndall::stress {
namespace {

/// Light 1e-6 … 1e8; comparable: what half floats hold with ease.
glm::vec3 draw_intensity(bool comparable, Random& random) {
    if (comparable) {
        const float brightness = logarithmic(random, 10, 3000);
        return brightness * glm::mix(glm::vec3(1), colour(random), 0.5f);
    }
    const float brightness = usual_or(random, 1, 1e5, 1e-6, 1e8);
    return brightness * colour(random);
}

/// Where lamps like to be: anywhere near, at the eye, on the floor, on the face of a box.
glm::vec3 draw_place(const StressFrame& frame, glm::vec3 origin, Random& random) {
    const double u = random.unit();
    if (u < 0.12) return frame.view.eye;
    if (u < 0.2) return origin + glm::vec3{random.linear(-20, 20), 0, random.linear(-20, 20)};
    if (u < 0.26) return origin + glm::vec3(-2, 1, -4);
    const glm::vec3 direction = random.direction();
    return origin + direction * usual_or(random, 1, 15, 1e-3, 1e3);
}

StressFrame::Lamp draw_comparable_lamp(const StressFrame& frame, glm::vec3 origin, Random& random) {
    StressFrame::Lamp lamp;
    Light& light = lamp.light;
    light.type = random.chance(0.5) ? LightType::spot : LightType::point;
    light.intensity = draw_intensity(true, random);
    light.range = logarithmic(random, 5, 60);
    light.radius = 0.01f;
    light.shadow = random.chance(0.8);
    light.outer_cone = static_cast<float>(random.linear(0.3, 1.4));
    light.inner_cone = light.outer_cone * static_cast<float>(random.linear(0, 0.7));
    const bool first = frame.lights.empty();
    const glm::vec3 place = first ? before_camera(frame.view, logarithmic(random, 1, 10))
                                  : origin + glm::vec3(0, 3, 0) + random.box(12);
    lamp.pose = test::pose(place, random.direction());
    return lamp;
}

StressFrame::Lamp draw_extreme_lamp(const StressFrame& frame, glm::vec3 origin, Random& random) {
    constexpr double right_angle = std::numbers::pi / 2;
    StressFrame::Lamp lamp;
    Light& light = lamp.light;
    light.type = random.chance(0.5) ? LightType::spot : LightType::point;
    light.intensity = draw_intensity(false, random);
    light.shadow = random.chance(0.6);
    light.range = usual_or(random, 2, 100, 1e-3, 1e6);
    light.radius = random.chance(0.3) ? 0.0f : usual_or(random, 0.01, 0.3, 1e-6, 1e2);
    light.outer_cone =
        random.chance(0.2) ? static_cast<float>(right_angle) : logarithmic(random, 1e-4, right_angle);
    light.inner_cone = light.outer_cone * static_cast<float>(random.pick({0.0, 1.0, random.unit()}));
    const glm::vec3 place = draw_place(frame, origin, random);
    lamp.pose = test::pose(place, axis_or_direction(random));
    return lamp;
}

}  // namespace

StressFrame::Lamp draw_sun(const Structure& structure, Random& random) {
    StressFrame::Lamp sun;
    sun.light.type = LightType::sun;
    sun.light.intensity = draw_intensity(structure.comparable, random);
    sun.light.shadow = random.chance(0.8);
    glm::vec3 direction = axis_or_direction(random);
    if (structure.comparable)  // above the horizon
        direction = glm::normalize(glm::vec3(direction.x, -std::abs(direction.y) - 0.2f, direction.z));
    sun.pose = test::pose(glm::vec3(0), direction);
    return sun;
}

void draw_lamps(StressFrame& frame, const Structure& structure, glm::vec3 origin, Random& random) {
    const int count = structure.lamps ? 1 + random.below(random.chance(0.1) ? 24 : 4) : 0;
    for (int i = 0; i < count; ++i)
        frame.lights.push_back(structure.comparable ? draw_comparable_lamp(frame, origin, random)
                                                    : draw_extreme_lamp(frame, origin, random));
    if (count > 0 && !structure.comparable && random.chance(0.5)) {  // one in view
        glm::mat4& pose = frame.lights.back().pose;
        pose[3] = glm::vec4(before_camera(frame.view, logarithmic(random, 0.1, 10)), 1);
    }
}

}  // namespace tyndall::stress
