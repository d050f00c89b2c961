#include "bench/sequences.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace tyndall::bench {
namespace {

using Settings = std::vector<std::string>;

const std::vector<std::string> noises{"none", "bayer", "white", "white_tile", "ign", "blue", "stbn", "fast"};

Settings joined(Settings a, const Settings& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Light is what is filtered, and history comes last, unless what is added to this says otherwise.
Settings march(int steps) {
    return {"technique=ray_march", fmt::format("steps={}", steps), "resolution=full", "reconstruct=light",
            "temporal_place=after"};
}

/// The exponential mean of the cloud thesis, and nothing else that could change it.
const Settings thesis_mean{"temporal=ema", "temporal_weight=0.1", "temporal_clip=false", "temporal_reject=false"};

std::vector<Pose> at_rest(std::size_t frames) {
    return std::vector<Pose>(frames);
}

Sequence sequence(const Place& place, glm::ivec2 size, const std::string& group, const std::string& name,
                  Settings settings, std::vector<Pose> poses) {
    return {&bench::place(place.name), size, group, name, std::move(settings), std::move(poses)};
}

/// Every noise over 32 frames, changing in its own way, then in the other ways (fixed noise is settled at once).
std::vector<Sequence> noise_sequences(const Place& place, glm::ivec2 size) {
    std::vector<Sequence> list;
    for (const char* time : {"own", "golden_ratio", "r2", "fixed"})
        for (const std::string& noise : noises) {
            const Settings settings{"noise=" + noise, std::string("noise_time=") + time, "filter=none"};
            list.push_back(sequence(place, size, time, noise, joined(joined(march(8), settings), thesis_mean),
                                    at_rest(std::string(time) == "fixed" ? 2 : 32)));
        }
    return list;
}

/// The noise `fast` was made for some filters; for the others the nearest of those is taken.
std::string fast_space_of(const std::string& filter) {
    return filter == "none" || filter == "gaussian15" ? "gaussian1" : filter;
}

/// Every spatial filter with every noise over 12 frames; then the filters' ways with depth.
std::vector<Sequence> filter_sequences(const Place& place, glm::ivec2 size) {
    std::vector<Sequence> list;
    const auto add = [&](const std::string& group, const std::string& filter, const std::string& depth,
                         const std::string& noise) {
        const Settings settings{"noise=" + noise,       "noise_time=own",
                                "fast_time=ema",        "fast_space=" + fast_space_of(filter),
                                "filter=" + filter,     "filter_depth=" + depth,
                                "temporal_place=before"};
        list.push_back(
            sequence(place, size, group, noise, joined(joined(march(8), settings), thesis_mean), at_rest(12)));
    };
    const std::vector<std::string> filters{"none",      "box3",      "box5",      "gaussian1",
                                           "binomial3", "binomial5", "gaussian15"};
    for (const std::string& filter : filters)
        for (const std::string& noise : noises) add(filter, filter, "relative", noise);
    for (const char* depth : {"none", "plane"})
        for (const std::string& filter : filters)
            if (filter != "none") add(filter + ", depth " + depth, filter, depth, "fast");
    return list;
}

/// 8 frames at rest, 8 in which the camera moves, 8 in which the lights do, 8 at rest.
std::vector<Pose> there_and_stay() {
    std::vector<Pose> poses;
    for (int frame = 0; frame < 32; ++frame)
        poses.push_back({std::clamp(frame - 7, 0, 8), std::clamp(frame - 15, 0, 8)});
    return poses;
}

/// The temporal paper's case: ten steps behind thin occluders.
std::vector<Sequence> temporal_sequences(const Place& place, glm::ivec2 size) {
    std::vector<Sequence> list;
    const std::vector<std::pair<std::string, Settings>> bases{
        {"white tile 4×4, uniform9",
         {"noise=white_tile", "noise_size=4", "noise_time=own", "filter=uniform9", "filter_depth=plane"}},
        {"Bayer, golden ratio", {"noise=bayer", "noise_time=golden_ratio", "filter=none"}},
        {"FAST", {"noise=fast", "noise_time=own", "filter=none"}},
        {"FAST, gaussian1", {"noise=fast", "noise_time=own", "filter=gaussian1", "filter_depth=plane"}},
        {"visibility, gaussian15",
         {"noise=bayer", "noise_time=golden_ratio", "filter=gaussian15", "reconstruct=visibility",
          "temporal_place=before"}}};
    for (const auto& [base, settings] : bases) {
        const auto add = [&](const std::string& name, const Settings& more) {
            list.push_back(
                sequence(place, size, base, name, joined(joined(march(10), settings), more), there_and_stay()));
        };
        add("off", {"temporal=off"});
        const auto history = [&](const std::string& mode, bool clip, bool reject) {
            const std::string weight = mode == "acceptance" ? "0.2" : "0.1";  // the paper's, the thesis'
            add(mode + (clip ? ", clip" : "") + (reject ? ", reject" : ""),
                {"temporal=" + mode, "temporal_weight=" + weight, fmt::format("temporal_clip={}", clip),
                 fmt::format("temporal_reject={}", reject)});
        };
        history("blend", false, false);
        for (const char* mode : {"ema", "acceptance", "accumulate"})
            for (const bool clip : {false, true})
                for (const bool reject : {false, true}) history(mode, clip, reject);
    }
    return list;
}

/// To and fro along 16 poses, never at rest.
std::vector<Pose> to_and_fro(int frames) {
    std::vector<Pose> poses;
    for (int frame = 0; frame < frames; ++frame) poses.push_back({16 - std::abs(frame % 32 - 16), 0});
    return poses;
}

/// What is left of a technique's error: in single frames of a moving camera, with history, and with history at
/// rest.
std::vector<Sequence> walk_sequences(const Place& place, glm::ivec2 size) {
    constexpr int frames = 96;
    std::vector<Sequence> list;
    for (const char* technique : {"ray_march", "billboards", "particles"}) {
        const auto add = [&](const char* name, const Settings& settings, std::vector<Pose> poses) {
            list.push_back(sequence(place, size, technique, name,
                                    joined({std::string("technique=") + technique}, settings), std::move(poses)));
        };
        add("moving, single frames", {"temporal=off"}, to_and_fro(33));
        add("moving", {}, to_and_fro(frames));
        add("at rest", {}, at_rest(frames));
    }
    return list;
}

/// For the tests: an image that stays, one that moves.
std::vector<Sequence> test_sequences(const Place& place, glm::ivec2 size) {
    const Settings settings{"noise=bayer", "noise_time=fixed", "filter=none", "temporal=off"};
    std::vector<Pose> motion{{0, 0}, {0, 0}, {1, 0}, {1, 1}};
    return {sequence(place, size, "rest", "bayer", joined(march(4), settings), at_rest(5)),
            sequence(place, size, "motion", "bayer", joined(march(4), settings), motion)};
}

struct Definition {
    std::string name, title, what;
    std::vector<std::string> places;
    std::function<std::vector<Sequence>(const Place&, glm::ivec2)> sequences;
    int steps;
    double FrameErrors::*measure;
};

const std::vector<Definition>& definitions() {
    static const std::vector<Definition> list{
        {"noise",
         "Noise and an exponential mean over 32 frames",
         "ray_march, 8 steps, no spatial filter, exponential mean of weight 0.1, no clipping and no rejection",
         {"Sun", "LocalLights", "Balance"},
         noise_sequences,
         8,
         &FrameErrors::error},
        {"filters",
         "Spatial filters behind an exponential mean over 12 frames",
         "ray_march, 8 steps, exponential mean of weight 0.1 and then the spatial filter, which knows depth; noise "
         "fast as it was made for that filter",
         {"Sun", "LocalLights", "Balance"},
         filter_sequences,
         8,
         &FrameErrors::error},
        {"temporal",
         "History with thin occluders, moving camera and moving lights",
         "ray_march, 10 steps; 8 frames at rest, 8 in which the camera moves (0.05 m and 0.5° a frame), 8 in which "
         "the lights do, 8 at rest; each frame against the ground truth of its pose, without its brightest 2% of "
         "pixels: a lamp that "
         "comes into view outweighs all else",
         {"slats_sun", "slats_spot", "teapot"},
         temporal_sequences,
         10,
         &FrameErrors::dim},
        {"walk",
         "A moving camera",
         "the defaults of each technique; the camera goes to and fro, 0.05 m and 0.5° a frame, or rests; each "
         "frame against the ground truth of its pose",
         {"LocalPM", "Sun", "Balance"},
         walk_sequences,
         8,
         &FrameErrors::error},
        {"sequences",
         "Sequences themselves, in seconds",
         "ray_march, 4 steps, Bayer noise",
         {"slats_spot"},
         test_sequences,
         4,
         &FrameErrors::error}};
    return list;
}

}  // namespace

std::string Sequence::key() const {
    return fmt::format("{}-{}x{} {}: {} [{}]", place->name, size.x, size.y, group, name, fmt::join(settings, " "));
}

const std::vector<std::string>& sequence_suite_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Definition& d : definitions()) list.push_back(d.name);
        return list;
    }();
    return names;
}

SequenceSuite make_sequence_suite(const SuiteRequest& request) {
    const auto definition = std::ranges::find(definitions(), request.name, &Definition::name);
    SequenceSuite suite{definition->name,    definition->title,       definition->what, {},
                        definition->measure, march(definition->steps)};
    for (const std::string& name : chosen_places(definition->name, definition->places, request.places))
        for (Sequence& s : definition->sequences(place(name), request.size))
            suite.sequences.push_back(std::move(s));
    return suite;
}

}  // namespace tyndall::bench
