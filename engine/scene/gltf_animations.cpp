#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/scene/gltf_parts.h"

namespace tyndall::gltf {
namespace {

template <class T, std::size_t n>
std::optional<T> by_name(const std::pair<std::string_view, T> (&names)[n], const std::string& name) {
    for (const auto& [known, value] : names)
        if (known == name) return value;
    return std::nullopt;
}

constexpr std::string_view flythrough = "flythrough";  // the level's path, which no one plays beside others

constexpr std::pair<std::string_view, Animation::Path> paths[] = {{"translation", Animation::Path::translation},
                                                                  {"rotation", Animation::Path::rotation},
                                                                  {"scale", Animation::Path::scale}};
constexpr std::pair<std::string_view, Animation::Interpolation> interpolations[] = {
    {"STEP", Animation::Interpolation::step},
    {"LINEAR", Animation::Interpolation::linear},
    {"CUBICSPLINE", Animation::Interpolation::cubic}};

Animation::Channel load_channel(const GltfFile& file, const tinygltf::Animation& animation,
                                const tinygltf::AnimationChannel& from, int node, const std::string& what) {
    const tinygltf::AnimationSampler& sampler = file.at(animation.samplers, from.sampler, what + ": sampler");
    const auto path = by_name(paths, from.target_path);
    if (!path) file.fail("{}: path {} does not exist", what, from.target_path);
    const auto interpolation = by_name(interpolations, sampler.interpolation);
    if (!interpolation) file.fail("{}: interpolation {} does not exist", what, sampler.interpolation);
    Animation::Channel to{node, *path, *interpolation, {}, {}};

    for (const double time : file.read(sampler.input, TINYGLTF_TYPE_SCALAR, what + " times")) {
        const auto t = static_cast<float>(time);
        if (t < 0 || (!to.times.empty() && t <= to.times.back()))
            file.fail("{}: time {} s; times must not be negative and must rise", what, t);
        to.times.push_back(t);
    }
    const bool rotation = to.path == Animation::Path::rotation;
    if (rotation) {
        to.values = file.read_vectors<4>(sampler.output, what + " values");
    } else {
        for (const glm::vec3& v : file.read_vectors<3>(sampler.output, what + " values"))
            to.values.emplace_back(v, 0);
    }
    const bool cubic = to.interpolation == Animation::Interpolation::cubic;
    const std::size_t per_key = cubic ? 3 : 1;
    if (to.values.size() != to.times.size() * per_key)
        file.fail("{}: {} values for {} times", what, to.values.size(), to.times.size());
    for (std::size_t i = cubic ? 1 : 0; rotation && i < to.values.size(); i += per_key) {
        const glm::quat q = file.quaternion(to.values[i], what + " values");
        to.values[i] = {q.x, q.y, q.z, q.w};
    }
    return to;
}

std::vector<Animation::Place> load_places(const GltfFile& file, const Json& extra, const std::string& what) {
    std::vector<Animation::Place> places;
    if (!extra.contains("places")) return places;
    const Json& list = extra["places"];
    if (!list.is_array()) file.fail("{}: a list expected", what);
    for (const Json& place : list) {
        if (!place.is_object() || !place.contains("name") || !place["name"].is_string() || !place.contains("time"))
            file.fail("{}: {{\"name\": text, \"time\": seconds}} expected", what);
        places.push_back({place["name"].get<std::string>(), file.number(place["time"], what + ": time", 0)});
    }
    return places;
}

/// Of those that play at once.
void doubt_two_of_a_node(const GltfFile& file, const Scene& scene) {
    std::map<std::pair<int, Animation::Path>, const Animation*> moved;
    for (const Animation& animation : scene.animations) {
        if (animation.name == flythrough) continue;
        for (const Animation::Channel& channel : animation.channels) {
            const Animation* other = moved.emplace(std::pair(channel.node, channel.path), &animation).first->second;
            if (other != &animation)
                file.doubt(
                    "animations \"{}\" and \"{}\" move the same node, and the later one wins; --animation NAME "
                    "plays one",
                    other->name, animation.name);
        }
    }
}

}  // namespace

void load_animations(const GltfFile& file, const std::vector<int>& nodes, const std::optional<std::string>& only,
                     Scene& scene) {
    const auto& animations = file.model().animations;
    if (only && std::ranges::find(animations, *only, &tinygltf::Animation::name) == animations.end()) {
        std::vector<std::string> names;
        for (const tinygltf::Animation& animation : animations) names.push_back(animation.name);
        throw UsageError(one_line(fmt::format("animation {}: not in {}, which has {}", *only, file.path().string(),
                                              names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")))));
    }
    for (std::size_t i = 0; i < animations.size(); ++i) {
        const tinygltf::Animation& from = animations[i];
        if (only && from.name != *only && from.name != flythrough) continue;
        const std::string what = fmt::format("animation {} \"{}\"", i, from.name);
        Animation to;
        to.name = from.name;
        for (const tinygltf::AnimationChannel& channel : from.channels) {
            const int node = file.at(nodes, channel.target_node, what + ": node");
            const bool morph = channel.target_path == "weights";
            if (morph) file.skip("{}: morph targets are not supported, ignored", what);
            if (morph || node < 0) continue;
            to.channels.push_back(load_channel(file, from, channel, node, what));
            to.duration = std::max(to.duration, to.channels.back().times.back());
            scene.nodes[static_cast<std::size_t>(node)].dynamic = true;
        }
        to.places = load_places(file, file.extras(from), what + ": extras.places");
        scene.animations.push_back(std::move(to));
    }
    doubt_two_of_a_node(file, scene);
    for (Node& node : scene.nodes)
        if (node.parent >= 0 && scene.nodes[static_cast<std::size_t>(node.parent)].dynamic) node.dynamic = true;
}

}  // namespace tyndall::gltf
