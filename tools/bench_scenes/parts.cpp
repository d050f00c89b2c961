#include "tools/bench_scenes/parts.h"

#include "tools/modeling/random.h"

namespace tyndall::bench_scenes {

namespace {

constexpr float kRadians = kPi / 180.0f;

void add_lamp_name(Scene& scene, Light& light) {
    light.name = "lamp_" + std::to_string(scene.lights.size());
}

Light light_of(const Lamp& lamp) {
    Light light;
    light.color = lamp.color;
    light.intensity = lamp.candela;
    light.range = lamp.range;
    light.radius = lamp.radius;
    light.shadow = lamp.shadow;
    return light;
}

}  // namespace

MaterialSet make_materials() {
    MaterialSet set;
    auto add = [&](const char* name, vec3 color) {
        Material& m = set.materials.emplace_back();
        m.name = name;
        m.base_color = {color, 1.0f};
    };
    add("ground", {0.24f, 0.22f, 0.19f});
    add("stone", {0.42f, 0.40f, 0.37f});
    add("plaster", {0.68f, 0.65f, 0.60f});
    add("wood", {0.34f, 0.21f, 0.12f});
    add("clay", {0.50f, 0.20f, 0.11f});
    add("dark", {0.05f, 0.05f, 0.055f});
    add("moss", {0.062f, 0.06f, 0.045f});
    return set;
}

vec3 sky_direction(float elevation, float azimuth) {
    const float e = elevation * kRadians, a = azimuth * kRadians;
    return {-cosine(e) * sine(a), sine(e), -cosine(e) * cosine(a)};
}

Scene empty_scene(const char* name, float exposure) {
    Scene scene;
    scene.name = name;
    scene.exposure = exposure;
    return scene;
}

void add_view(Scene& scene, vec3 eye, vec3 target, float yfov, const char* name) {
    scene.add_camera(name, yfov, looking_along(eye, glm::normalize(target - eye)));
}

void add_sun(Scene& scene, vec3 to_sun, float lux, vec3 color) {
    Light sun;
    sun.name = "sun";
    sun.type = Light::Type::Sun;
    sun.color = color;
    sun.intensity = lux;
    scene.add_light(sun, vec3(0), looking_along(vec3(0), -to_sun).rotation());
}

int add_point(Scene& scene, const Lamp& lamp) {
    Light light = light_of(lamp);
    add_lamp_name(scene, light);
    return scene.add_light(light, lamp.position);
}

int add_spot(Scene& scene, const Lamp& lamp, vec3 target, float inner, float outer) {
    Light light = light_of(lamp);
    add_lamp_name(scene, light);
    light.type = Light::Type::Spot;
    light.inner = inner * kRadians;
    light.outer = outer * kRadians;
    const vec3 along = glm::normalize(target - lamp.position);
    return scene.add_light(light, lamp.position, looking_along(lamp.position, along).rotation());
}

void add_ground(Scene& scene, float half_width, Surface surface) {
    Mesh ground{"ground", {}, mat4(1.0f)};
    box(ground, surface, {-half_width, -0.5f, -half_width}, {half_width, 0.0f, half_width});
    scene.add_static(std::move(ground));
}

void bars(Mesh& mesh, Surface surface, vec3 a, vec3 b, float width, float pitch, float height) {
    const vec3 along = glm::normalize(b - a), half = vec3(0.5f * width, 0.0f, 0.5f * width);
    const int count = static_cast<int>(glm::length(b - a) / pitch + 1e-3f) + 1;
    for (int i = 0; i < count; ++i) {
        const vec3 foot = a + along * (pitch * static_cast<float>(i));
        box(mesh, surface, foot - half, foot + half + vec3(0, height, 0), kBottom);
    }
}

}  // namespace tyndall::bench_scenes
