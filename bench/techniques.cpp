#include "bench/techniques.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/core/check.h"

namespace tyndall::bench {
namespace {

/// Ray marching with one noise and one filter, for the suites that compare these.
Family march(const std::string& name, const std::string& noise, const std::string& filter, const std::string& color,
             Marker marker, const std::vector<std::string>& steps = {}) {
    return {name,  "ray_march", {"noise=" + noise, "filter=" + filter, "reconstruct=light"}, "steps", steps,
            color, marker};
}

}  // namespace

const std::vector<Family>& families() {
    static const std::vector<Family> list{
        march("march, undithered", "none", "none", "#9a9a9a", Marker::circle, {"8", "32"}),
        march("march, undithered, blur", "none", "gaussian15", "#3d3d3d", Marker::circle),
        march("march, white", "white_tile", "none", "#f0a868", Marker::triangle),
        march("march, white, blur", "white_tile", "gaussian15", "#c4500a", Marker::triangle),
        march("march, Bayer", "bayer", "none", "#7db4e0", Marker::square),
        march("march, Bayer, blur", "bayer", "gaussian15", "#0b5fa5", Marker::square, {"2", "8", "32"}),
        {"march", "ray_march", {}, "steps", {"2", "4", "8", "16", "32"}, "#1f9e89", Marker::square},
        {"march, mean over frames",
         "ray_march",
         {},
         "steps",
         {"2", "8"},
         "#12355b",
         Marker::diamond,
         settled_frames},
        {"froxel",
         "froxel",
         {"froxel_history=0"},
         "froxels_z",
         {"16", "32", "64", "128"},
         "#b0307a",
         Marker::diamond},
        {"froxel, history",
         "froxel",
         {},
         "froxels_z",
         {"16", "32", "64", "128"},
         "#e58ac0",
         Marker::diamond,
         settled_frames},
        {"analytic fog", "analytic_fog", {}, "", {}, "#5c5c00", Marker::circle},
        {"radial shafts", "radial_shafts", {}, "radial_samples", {"8", "32"}, "#a08a00", Marker::triangle},
        {"billboards", "billboards", {}, "billboard_layers", {"8", "32"}, "#7a4fbf", Marker::cross},
        {"particles", "particles", {}, "particle_count", {"8192", "65536"}, "#2f7f4f", Marker::plus},
        {"shaft geometry", "shaft_geometry", {}, "shaft_grid", {"64", "256", "1024"}, "#b84a62", Marker::square},
        {"epipolar", "epipolar", {}, "steps", {"1", "4", "8"}, "#d62728", Marker::plus},
        {"auto, half resolution",
         "auto",
         {"resolution=half"},
         "epipolar_spacing",
         {"2", "1"},
         "#f58f8f",
         Marker::star},
        {"auto", "auto", {}, "epipolar_spacing", {"4", "2", "1"}, "#000000", Marker::star},
        {"reference", "reference", {}, "", {}, "#009e73", Marker::star, 0, true},
    };
    return list;
}

const Family& family(const std::string& name) {
    const auto found = std::ranges::find(families(), name, &Family::name);
    TYNDALL_CHECK(found != families().end());
    return *found;
}

std::vector<std::string> base_settings(const std::string& technique, int history_frames) {
    std::vector<std::string> settings{"technique=" + technique};
    if (history_frames == 0) settings.emplace_back("temporal=off");
    return settings;
}

std::vector<Configuration> expand(const Family& family) {
    Configuration base;
    base.family = family.name;
    base.settings = base_settings(family.technique, family.history_frames);
    base.settings.insert(base.settings.end(), family.settings.begin(), family.settings.end());
    base.history_frames = family.history_frames;
    base.weight = family.limit ? 1000 : 12;
    if (family.cost_key.empty()) return {base};
    std::vector<Configuration> all;
    for (const std::string& value : family.costs) {
        all.push_back(base);
        all.back().settings.push_back(family.cost_key + "=" + value);
        all.back().label = value;
        if (family.cost_key == "steps") all.back().weight = 4 + std::stod(value);
    }
    return all;
}

std::string Configuration::name() const {
    return fmt::format("{} [{}]", family, fmt::join(settings, " "));
}

std::string Point::subject() const {
    std::string text = fmt::format("{}-{}x{}", place->name, size.x, size.y);
    text += pose.name();
    if (edit.lamps >= 0) text += fmt::format("-lamps{}", edit.lamps);
    if (!light_transmittance) text += "-light_unattenuated";
    if (edit.spheres >= 0) text += fmt::format("-spheres{}", edit.spheres);
    return text;
}

std::string Point::key() const {
    return fmt::format("{} {}={} {}", subject(), variable, value, configuration.name());
}

}  // namespace tyndall::bench
