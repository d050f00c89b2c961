#include "bench/places.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/render/frame_facts.h"
#include "engine/scene/data_root.h"
#include "session/session.h"

namespace tyndall::bench {
namespace {

const std::string abbey = "assets/levels/abbey.glb";

std::string own(const std::string& name) {
    return "assets/bench/" + name + ".glb";
}

/// Scenes with one camera, named after the scene.
std::vector<Place> singles(std::initializer_list<const char*> names) {
    std::vector<Place> places;
    for (const char* name : names) places.push_back({name, own(name)});
    return places;
}

}  // namespace

const std::vector<Place>& level_places() {
    static const std::vector<Place> places = [] {
        std::vector<Place> list;
        for (const char* camera : {"LocalPM", "Close", "LocalLights", "Sun", "Depth", "Balance"})
            list.push_back({camera, abbey, camera});
        return list;
    }();
    return places;
}

const std::vector<Place>& scene_places() {
    static const std::vector<Place> places = [] {
        std::vector<Place> list = singles({"slats_sun", "slats_spot"});
        list.push_back({"teapot", own("teapot"), "view", 1.0});
        for (const char* camera : {"inside_away", "inside_towards", "outside"})
            list.push_back({camera, own("depths"), camera});
        const auto rest = singles({"cube", "ragged", "lamps_open", "lamps_shadowed", "open_sun"});
        list.insert(list.end(), rest.begin(), rest.end());
        return list;
    }();
    return places;
}

const std::vector<Place>& torture_places() {
    static const std::vector<Place> places =
        singles({"torture_posts", "torture_slats", "torture_lamp_at_eye", "torture_lamp_behind_wall", "torture_sky",
                 "torture_dense", "torture_forward", "torture_backward"});
    return places;
}

const Place& place(const std::string& name) {
    const Place* found = nullptr;
    for (const auto* list : {&level_places(), &scene_places(), &torture_places()})
        for (const Place& candidate : *list)
            if (candidate.name == name) found = &candidate;
    TYNDALL_CHECK(found != nullptr);
    return *found;
}

PlaceFacts place_facts(const Place& place, float aspect) {
    Scene scene = load_gltf(data_root() / place.scene);
    animate(scene, place.time);
    const FrameFacts facts = compute_facts(scene, camera_view(scene, place.camera, aspect));
    PlaceFacts result;
    result.lamps_in_view = facts.local_lights_in_view;
    result.has_sun = facts.has_sun;
    result.lamps = static_cast<int>(
        std::ranges::count_if(scene.lights, [](const Light& l) { return l.type != LightType::sun; }));
    return result;
}

}  // namespace tyndall::bench
