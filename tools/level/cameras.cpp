// The places, the path through them, where the player starts, and the fog.
#include "tools/level/parts.h"
#include "tools/level/path.h"
#include "tools/modeling/media.h"

namespace tyndall::level {

namespace {

using nlohmann::json;

struct Place {
    std::string name;
    float yfov;
    Pose pose;
};

std::vector<Place> places() {
    return {
        {"LocalPM", 60.0f, {{-8.6f, 1.75f, -2.4f}, 99.0f, 9.0f}},
        {"Close", 62.0f, {{-20.5f, -1.4f, 11.05f}, 96.0f, -7.0f}},
        {"LocalLights", 58.0f, {{100.0f, street_height(100.0f) + 2.5f, 0.7f}, 90.0f, 5.0f}},
        {"Sun", 60.0f, {{-11.0f, -1.3f, 24.4f}, 125.0f, 14.0f}},
        {"Depth", 60.0f, {{-53.8f, -1.25f, 70.3f}, 47.0f, -5.0f}},
        {"Balance", 60.0f, {{-37.4f, -1.25f, 15.2f}, 174.0f, 4.0f}},
        {"Glass", 58.0f, {{1.9f, -1.35f, 25.9f}, -63.0f, -4.0f}},
    };
}

std::vector<Waypoint> way() {
    auto street = [](float x) { return street_height(x) + 2.3f; };
    std::vector<Waypoint> w{
        {0.0f, {{103.6f, street(103.6f) - 0.2f, 0.2f}, 94.0f, 1.0f}, ""},
        {3.0f, {}, "LocalLights"},
        {9.0f, {{66.0f, street(66.0f), -0.9f}, 87.0f, 4.0f}, ""},
        {14.0f, {{30.0f, street(30.0f) + 0.2f, 0.6f}, 92.0f, 7.0f}, ""},
        {17.0f, {{9.0f, 1.6f, 0.0f}, 90.0f, 7.0f}, ""},
        {19.0f, {{0.5f, 1.8f, 0.0f}, 90.0f, 5.0f}, ""},
        {22.0f, {}, "LocalPM"},
        {25.0f, {{-12.9f, 1.7f, 2.6f}, 140.0f, 2.0f}, ""},
        {27.0f, {{-13.75f, 1.65f, 6.0f}, 178.0f, -2.0f}, ""},
        {28.5f, {{-13.75f, 1.6f, 10.3f}, 150.0f, -8.0f}, ""},
        {29.7f, {{-14.5f, 1.5f, 11.2f}, 105.0f, -14.0f}, ""},
        {31.5f, {{-17.4f, 0.0f, 11.3f}, 92.0f, -12.0f}, ""},
        {33.5f, {}, "Close"},
        {35.6f, {{-22.4f, -1.38f, 11.7f}, 172.0f, -1.0f}, ""},
        {36.8f, {{-22.4f, -1.38f, 14.2f}, 190.0f, 3.0f}, ""},
        {38.4f, {{-19.0f, -1.3f, 17.4f}, 206.0f, 5.0f}, ""},
        {43.0f, {}, "Sun"},
        {46.0f, {{-18.5f, -1.2f, 21.4f}, 112.0f, 8.0f}, ""},
        {48.6f, {{-30.0f, -1.2f, 16.6f}, 132.0f, 6.0f}, ""},
        {51.0f, {}, "Balance"},
        {54.6f, {{-38.6f, -1.2f, 38.0f}, 176.0f, 3.0f}, ""},
        {57.0f, {{-38.4f, -1.2f, 57.5f}, 160.0f, 0.0f}, ""},
        {58.0f, {{-38.8f, -1.2f, 63.5f}, 135.0f, -2.0f}, ""},
        {59.2f, {{-44.5f, -1.2f, 68.6f}, 100.0f, -4.0f}, ""},
        {61.0f, {}, "Depth"},
        {62.0f, {{-53.9f, -1.24f, 70.3f}, 47.0f, -5.0f}, ""},
    };
    for (Waypoint& p : w) {
        for (const Place& place : places()) {
            if (p.place == place.name) p.pose = place.pose;
        }
    }
    return w;
}

// White fog: scattering with a trace of absorption.
Coefficients fog(float scattering, float anisotropy) {
    return {scattering, scattering * 0.03f, anisotropy};
}

void cloud(Level& level, vec3 centre, vec3 radii, float scattering, float noise_scale, int seed) {
    json m = ellipsoid_medium(fog(scattering, 0.45f), centre, radii, std::min({radii.x, radii.y, radii.z}) * 0.7f);
    m["noise"] = medium_noise(noise_scale, 0.85f, seed);
    level.media.push_back(m);
}

json& box_fog(Level& level, vec3 centre, vec3 size, float scattering, float anisotropy, float softness) {
    level.media.push_back(box_medium(fog(scattering, anisotropy), centre, size, softness));
    return level.media.back();
}

}  // namespace

void add_media(Level& level) {
    level.media.push_back(height_medium(fog(0.0065f, 0.45f), 0.0f, 8.0f));
    // LocalPM: mist on the nave's floor, incense over the braziers, the font and the altar.
    json& floor_mist = box_fog(level, {-23.0f, 1.4f, 0.0f}, {36.0f, 2.8f, 17.0f}, 0.15f, 0.4f, 0.8f);
    floor_mist["noise"] = medium_noise(2.2f, 0.9f, 11);
    floor_mist["height"] = {{"base", 0.0f}, {"falloff", 0.7f}};
    box_fog(level, {-22.5f, 6.0f, 0.0f}, {44.0f, 16.0f, 19.0f}, 0.022f, 0.5f, 2.0f);
    cloud(level, {-22.75f, 2.9f, 0.0f}, {2.6f, 2.3f, 2.4f}, 0.35f, 1.1f, 1);
    cloud(level, {-29.8f, 3.0f, 2.7f}, {1.9f, 2.6f, 1.8f}, 0.50f, 0.9f, 2);
    cloud(level, {-29.4f, 3.4f, -2.6f}, {2.0f, 2.9f, 1.9f}, 0.50f, 0.9f, 3);
    cloud(level, {-15.5f, 4.0f, -2.4f}, {3.6f, 1.5f, 2.2f}, 0.22f, 1.3f, 4);
    cloud(level, {-40.3f, 3.6f, 0.0f}, {2.8f, 2.6f, 4.0f}, 0.25f, 1.4f, 5);
    cloud(level, {-18.0f, 6.5f, 1.5f}, {4.5f, 2.4f, 2.6f}, 0.20f, 1.8f, 6);
    // Sun: mist under and around the tree. Balance: thick fog along the loggia.
    box_fog(level, {-19.0f, 0.5f, 35.5f}, {33.0f, 12.0f, 46.0f}, 0.020f, 0.5f, 3.0f);
    box_fog(level, {-42.0f, 0.0f, 38.0f}, {13.0f, 11.0f, 52.0f}, 0.065f, 0.55f, 2.5f);
}

void add_cameras(Level& level) {
    for (const Place& place : places()) level.add_camera(place.name, place.yfov, place.pose);
    level.add_camera("flythrough", 60.0f, way().front().pose);
    level.animations.push_back(flythrough(way(), static_cast<int>(level.nodes.size()) - 1));
    Node start;
    start.name = "player_start";
    start.translation = {96.0f, street_height(96.0f) - 0.05f, 0.0f};
    start.rotation = yaw_rotation(90.0f);
    level.add_node(start);
}

}  // namespace tyndall::level
