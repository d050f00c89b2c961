// Sun, ground and fog to the horizon.
#include "tools/bench_scenes/parts.h"

namespace tyndall::bench_scenes {

Scene open_sun() {
    Scene scene = empty_scene("open_sun", 13.0f);
    add_ground(scene, 3'000.0f);
    add_sun(scene, sky_direction(7.0f, 10.0f), 40'000.0f, {1.0f, 0.83f, 0.62f});
    scene.media.push_back(height_medium({0.02f, 0.0003f, 0.6f}, 0.0f, 3.5f));
    add_view(scene, {0.0f, 12.0f, 0.0f}, {3.0f, 10.5f, -30.0f}, 55.0f);
    return scene;
}

Scene torture_sky() {
    Scene scene = empty_scene("torture_sky", 15.3f);
    add_ground(scene, 20'000.0f);
    Mesh post{"post", {}, mat4(1.0f)};
    box(post, kClay, {-0.05f, 0.0f, -0.05f}, {0.05f, 2.2f, 0.05f}, kBottom);
    const int mesh = scene.add_mesh(std::move(post));
    scene.add_instance("post", mesh, {-2.4f, 0.0f, -6.0f});
    add_sun(scene, sky_direction(13.0f, 16.0f), 70'000.0f, {1.0f, 0.8f, 0.56f});
    scene.media.push_back(global_medium({1e-4f, 0.0f, 0.75f}));
    scene.media.push_back(height_medium({0.0008f, 0.0f, 0.5f}, 0.0f, 25.0f));
    add_view(scene, {0.0f, 1.8f, 0.0f}, {0.0f, 5.0f, -20.0f}, 60.0f);
    return scene;
}

Scene torture_posts() {
    Scene scene = empty_scene("torture_posts", 13.8f);
    add_ground(scene, 60.0f);
    constexpr int kRows = 36, kPosts = 40;
    constexpr float kPitch = 0.6f, kWidth = 0.01f;
    Mesh row{"row", {}, mat4(1.0f)};
    for (int i = 0; i < kPosts; ++i) {
        const float x = kPitch * (static_cast<float>(i) - 0.5f * kPosts),
                    h = 1.1f + 0.1f * static_cast<float>((i * 7) % 10);
        const vec3 foot(x, 0.0f, 0.12f * static_cast<float>((i * 5) % 4));
        const vec3 half(0.5f * kWidth, 0.0f, 0.5f * kWidth);
        box(row, kDark, foot - half, foot + half + vec3(0, h, 0), kBottom);
    }
    const int mesh = scene.add_mesh(std::move(row));
    for (int i = 0; i < kRows; ++i)
        scene.add_instance(
            "row", mesh,
            {0.23f * static_cast<float>((i * 3) % 7) - 0.7f, 0.0f, -2.0f - kPitch * static_cast<float>(i)});
    add_sun(scene, sky_direction(9.0f, -16.0f), 30'000.0f, {1.0f, 0.7f, 0.42f});
    scene.media.push_back(global_medium({0.02f, 0.0f, 0.6f}));
    add_view(scene, {0.0f, 1.5f, 0.0f}, {0.0f, 1.1f, -8.0f}, 50.0f);
    return scene;
}

}  // namespace tyndall::bench_scenes
