#include "bench/suites.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "bench/sampling.h"
#include "bench/sequences.h"
#include "bench/techniques.h"
#include "engine/core/error.h"
#include "volumetrics/settings.h"
#include "volumetrics/technique.h"

namespace tyndall::bench {
namespace {

using Places = std::vector<Place>;

/// What a suite is made of: its places, and the groups each gives.
struct Definition {
    std::string name;
    Suite frame;  ///< all but the groups
    std::function<Places()> places;
    std::function<std::vector<Group>(const Place&, const PlaceFacts&, const SuiteRequest&)> groups;
};

Places joined(std::initializer_list<Places> lists) {
    Places all;
    for (const Places& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

Places named(std::initializer_list<const char*> names) {
    Places all;
    for (const char* name : names) all.push_back(place(name));
    return all;
}

/// The technique with settings beyond its defaults, one of them a count that buys accuracy.
Configuration with_count(const std::string& family_name, std::vector<std::string> settings, const std::string& key,
                         double count, const std::string& curve = "") {
    Configuration c;
    c.family = family_name;
    const Family& row = family(family_name);
    c.settings = base_settings(row.technique, row.history_frames);
    c.settings.insert(c.settings.end(), row.settings.begin(), row.settings.end());
    c.settings.insert(c.settings.end(), settings.begin(), settings.end());
    c.settings.push_back(fmt::format("{}={}", key, count));
    c.label = fmt::format("{}", count);
    c.curve = curve;
    c.history_frames = row.history_frames;
    c.weight = 4 + (key == "steps" ? count : 8);
    return c;
}

Point point(const Place& place, glm::ivec2 size, Configuration c, const std::string& variable, double value) {
    Point p;
    p.place = &bench::place(place.name);
    p.size = size;
    p.configuration = std::move(c);
    p.variable = variable;
    p.value = value;
    return p;
}

double label_value(const Configuration& c) {
    return c.label.empty() ? 0 : std::stod(c.label);
}

/// Every family at each of its costs.
std::vector<Group> front_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    Group group{place.name, {}, facts};
    for (const Family& f : families()) {
        if (request.against_gpu && f.technique == "reference") continue;
        for (const Configuration& c : expand(f))
            group.points.push_back(point(place, request.size, c, f.cost_key, label_value(c)));
    }
    return {group};
}

/// Every family at its cheapest and its dearest.
std::vector<Group> stress_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    Group group{place.name, {}, facts};
    for (const Family& f : families()) {
        if (request.against_gpu && f.limit) continue;
        const std::vector<Configuration> all = expand(f);
        if (all.empty()) continue;
        group.points.push_back(point(place, request.size, all.front(), f.cost_key, label_value(all.front())));
        if (all.size() > 1)
            group.points.push_back(point(place, request.size, all.back(), f.cost_key, label_value(all.back())));
    }
    return {group};
}

const std::string standard = "march, Bayer, blur";

/// Each technique as it comes, once its history has settled: its last row names it.
std::vector<Group> approaches_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    Group group{place.name, {}, facts};
    for (const std::string& technique : volumetrics::technique_names()) {
        const auto row = std::ranges::find(families().rbegin(), families().rend(), technique, &Family::technique);
        if (row == families().rend() || (row->limit && request.against_gpu)) continue;
        Configuration c;
        c.family = row->name;
        c.history_frames = row->limit ? 0 : settled_frames;
        c.settings = base_settings(technique, c.history_frames);
        c.weight = row->limit ? 1000 : 12;
        group.points.push_back(point(place, request.size, c, "", 0));
    }
    return {group};
}

std::vector<Group> passes_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    return {{place.name, {point(place, request.size, with_count(standard, {}, "steps", 8), "steps", 8)}, facts}};
}

std::vector<Group> smoke_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    Group group{place.name, {}, facts};
    for (const char* name : {"march, undithered", "march, Bayer, blur"})
        for (const int steps : {2, 8})
            group.points.push_back(
                point(place, request.size, with_count(name, {}, "steps", steps), "steps", steps));
    return {group};
}

/// Undithered steps against eight dithered and blurred ones. Light reaches the medium unattenuated, as in the
/// thesis: the march does not know what local media take of it, and that error would be all there is to see.
std::vector<Group> headline_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    Group group{place.name, {}, facts, true};
    group.points.push_back(point(place, request.size, with_count(standard, {}, "steps", 8), "steps", 8));
    for (const int steps : {8, 11, 16, 23, 32, 45, 64, 91, 128, 181, 256, 362, 512})
        group.points.push_back(
            point(place, request.size, with_count("march, undithered", {}, "steps", steps), "steps", steps));
    for (Point& p : group.points) p.light_transmittance = false;
    return {group};
}

/// Without attenuation of the light, as above: else the march converges to another limit where media are local.
std::vector<Group> convergence_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    Group group{place.name, {}, facts};
    std::vector<std::string> lamp_rules{""};
    if (facts.lamps_in_view > 0) lamp_rules = {"segment", "center"};
    for (const std::string& rule : lamp_rules)
        for (const char* name : {"march, undithered", "march, Bayer"})
            for (int steps = 1; steps <= 512; steps *= 2) {
                std::vector<std::string> settings{"stepping=uniform"};
                if (!rule.empty()) settings.push_back("lamp_integration=" + rule);
                group.points.push_back(
                    point(place, request.size, with_count(name, settings, "steps", steps, rule), "steps", steps));
            }
    for (Point& p : group.points) p.light_transmittance = false;
    return {group};
}

/// One variable at a time from the same standard: eight Bayer-dithered steps with blur.
std::vector<Group> scaling_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    std::vector<Group> groups;
    const auto add = [&](const std::string& variable, const std::vector<Point>& points) {
        groups.push_back({place.name + ", " + variable, points, facts});
    };
    const auto at = [&](const std::string& variable, double value) {
        return point(place, request.size, with_count(standard, {}, "steps", 8), variable, value);
    };
    std::vector<Point> points;
    for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        const glm::ivec2 size = glm::max(glm::ivec2(glm::dvec2(request.size) * factor + 0.5), glm::ivec2(1));
        points.push_back(
            point(place, size, with_count(standard, {}, "steps", 8), "pixels", double(size.x) * size.y));
        points.back().configuration.weight *= factor * factor;
    }
    add("pixels", points);
    points.clear();
    for (const int steps : {1, 2, 4, 8, 16, 32, 64, 128})
        points.push_back(point(place, request.size, with_count(standard, {}, "steps", steps), "steps", steps));
    add("steps", points);
    points.clear();
    for (int lamps = 1; facts.lamps_in_view > 0; lamps = std::min(2 * lamps, facts.lamps)) {
        points.push_back(at("lamps", lamps));
        points.back().edit.lamps = lamps;
        if (lamps == facts.lamps) break;
    }
    if (!points.empty()) add("lamps", points);
    if (place.name != "cube") return groups;
    points.clear();
    for (const int spheres : {1, 2, 4, 8, 16, 32, 64, 128}) {
        points.push_back(at("media", spheres));
        points.back().edit.spheres = spheres;
    }
    add("media", points);
    points.clear();
    for (const double factor : {0.25, 0.5, 1.0, 2.0}) {
        const int x = int(160 * factor), y = int(90 * factor), z = int(64 * factor);
        points.push_back(point(place, request.size,
                               with_count(standard,
                                          {fmt::format("froxels_x={}", x), fmt::format("froxels_y={}", y),
                                           fmt::format("froxels_z={}", z)},
                                          "steps", 8),
                               "froxels", double(x) * y * z));
    }
    add("froxels", points);
    return groups;
}

Suite frame(const std::string& title, bool times, bool errors, bool display) {
    Suite s;
    s.title = title;
    s.times = times;
    s.errors = errors;
    s.display = display;
    return s;
}

const std::vector<Definition>& definitions() {
    static const std::vector<Definition> list{
        {"front", frame("Error against time", true, true, true),
         [] {
             return joined({level_places(), scene_places()});
         },
         front_groups},
        {"stress", frame("Scenes built to break numerics", true, true, true), torture_places, stress_groups},
        {"approaches", frame("Each technique as it comes", true, true, true),
         [] {
             return named({"slats_sun", "slats_spot", "lamps_open", "lamps_shadowed", "inside_towards", "outside",
                           "torture_sky", "teapot", "cube", "ragged", "LocalLights", "Sun", "Balance"});
         },
         approaches_groups},
        {"scaling", frame("Cost against one variable at a time", true, false, false),
         [] {
             return named({"cube", "slats_sun", "lamps_open", "lamps_shadowed"});
         },
         scaling_groups},
        {"passes", frame("Time of each pass", true, false, false), level_places, passes_groups},
        {"headline", frame("Undithered steps that equal eight dithered ones", true, true, false), level_places,
         headline_groups},
        {"convergence", frame("Error against steps", false, true, false),
         [] {
             return named({"open_sun", "lamps_open", "lamps_shadowed", "slats_sun"});
         },
         convergence_groups},
        {"resolution", frame("March at lower resolutions", true, true, false), level_places, resolution_groups},
        {"ingredients", frame("What each ingredient is worth", true, true, false),
         [] {
             return named({"Sun", "LocalLights", "Balance"});
         },
         ingredient_groups},
        {"smoke", frame("The benchmark itself, in seconds", true, true, true),
         [] {
             return named({"open_sun", "lamps_open"});
         },
         smoke_groups},
    };
    return list;
}

}  // namespace

const std::vector<std::string>& suite_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Definition& d : definitions()) list.push_back(d.name);
        list.insert(list.end(), sequence_suite_names().begin(), sequence_suite_names().end());
        return list;
    }();
    return names;
}

std::vector<std::string> chosen_places(const std::string& suite, std::vector<std::string> places,
                                       const std::vector<std::string>& wanted) {
    for (const std::string& name : wanted)
        if (std::ranges::find(places, name) == places.end())
            throw UsageError(
                fmt::format("--scene {}: not in suite {}, which has {}", name, suite, fmt::join(places, ", ")));
    if (!wanted.empty())
        std::erase_if(places, [&](const std::string& p) { return std::ranges::find(wanted, p) == wanted.end(); });
    return places;
}

std::string default_reference(const std::string& suite) {
    if (suite == "convergence") return "gpu";
    const bool sampling = suite == "resolution" || suite == "ingredients" ||
                          std::ranges::find(sequence_suite_names(), suite) != sequence_suite_names().end();
    return sampling ? "march" : "cpu";
}

Suite make_suite(const SuiteRequest& request) {
    const auto definition = std::ranges::find(definitions(), request.name, &Definition::name);
    if (definition == definitions().end())
        throw UsageError(
            fmt::format("--suite {}: expected one of {}", request.name, fmt::join(suite_names(), ", ")));
    Suite suite = definition->frame;
    suite.name = definition->name;
    std::vector<std::string> places;
    for (const Place& p : definition->places()) places.push_back(p.name);
    for (const std::string& name : chosen_places(suite.name, places, request.places)) {
        const Place& p = place(name);
        const PlaceFacts facts = place_facts(p, float(request.size.x) / float(request.size.y));
        for (Group& group : definition->groups(p, facts, request)) suite.groups.push_back(std::move(group));
    }
    return suite;
}

}  // namespace tyndall::bench
