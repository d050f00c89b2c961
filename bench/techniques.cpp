#include "bench/techniques.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/core/check.h"

namespace tyndall::bench {
namespace {

/// Ray marching with one noise and one filter: one curve family of six.
Family march(const std::string& name, const std::string& noise, const std::string& filter, const std::string& color,
             Marker marker) {
    return {name,
            "ray_march",
            {"noise=" + noise, "filter=" + filter, "reconstruct=light"},
            {{"lamp_integration", {"segment", "center"}, true}, {"steps", {"2", "4", "8", "16", "32", "64"}}},
            "steps",
            color,
            marker};
}

}  // namespace

const std::vector<Family>& families() {
    static const std::vector<Family> list{
        march("march, undithered", "none", "none", "#9a9a9a", Marker::circle),
        march("march, undithered, blur", "none", "gaussian15", "#3d3d3d", Marker::circle),
        march("march, white", "white_tile", "none", "#f0a868", Marker::triangle),
        march("march, white, blur", "white_tile", "gaussian15", "#c4500a", Marker::triangle),
        march("march, Bayer", "bayer", "none", "#7db4e0", Marker::square),
        march("march, Bayer, blur", "bayer", "gaussian15", "#0b5fa5", Marker::square),
        {"march", "ray_march", {}, {{"steps", {"2", "4", "8", "16", "32"}}}, "steps", "#1f9e89", Marker::square},
        {"march, mean over frames",
         "ray_march",
         {},
         {{"steps", {"2", "4", "8", "16", "32"}}},
         "steps",
         "#12355b",
         Marker::diamond,
         settled_frames},
        {"froxel",
         "froxel",
         {"froxel_history=0"},
         {{"lamp_integration", {"segment", "center"}, true}, {"froxels_z", {"16", "32", "64", "128"}}},
         "froxels_z",
         "#b0307a",
         Marker::diamond},
        {"froxel, history",
         "froxel",
         {},
         {{"froxels_z", {"16", "32", "64", "128"}}},
         "froxels_z",
         "#e58ac0",
         Marker::diamond,
         settled_frames},
        {"analytic fog", "analytic_fog", {}, {}, "", "#5c5c00", Marker::circle},
        {"radial shafts",
         "radial_shafts",
         {},
         {{"radial_samples", {"8", "16", "32", "64"}}},
         "radial_samples",
         "#a08a00",
         Marker::triangle},
        {"billboards",
         "billboards",
         {},
         {{"billboard_layers", {"8", "16", "32", "64"}}},
         "billboard_layers",
         "#7a4fbf",
         Marker::cross},
        {"particles",
         "particles",
         {},
         {{"particle_count", {"8192", "32768", "65536", "262144"}}},
         "particle_count",
         "#2f7f4f",
         Marker::plus},
        {"shaft geometry",
         "shaft_geometry",
         {},
         {{"shaft_grid", {"64", "128", "256", "512", "1024"}}},
         "shaft_grid",
         "#b84a62",
         Marker::square},
        {"epipolar", "epipolar", {}, {{"steps", {"1", "2", "4", "8", "16"}}}, "steps", "#d62728", Marker::plus},
        {"reference", "reference", {}, {}, "", "#009e73", Marker::star, 0, true},
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

std::vector<Configuration> expand(const Family& family, const PlaceFacts& facts) {
    Configuration base;
    base.family = family.name;
    base.settings = base_settings(family.technique, family.history_frames);
    base.settings.insert(base.settings.end(), family.settings.begin(), family.settings.end());
    base.history_frames = family.history_frames;
    std::vector<Configuration> all{base};
    for (const Axis& axis : family.axes) {
        if (axis.lamps_only && facts.lamps_in_view == 0) continue;
        std::vector<Configuration> next;
        for (const Configuration& before : all)
            for (const std::string& value : axis.values) {
                Configuration c = before;
                c.settings.push_back(axis.key + "=" + value);
                if (axis.key == family.cost_key) {
                    c.label = value;
                    c.weight = 4 + std::stod(value);
                } else if (value != axis.values.front()) {
                    c.curve += (c.curve.empty() ? "" : ", ") + value;
                }
                next.push_back(std::move(c));
            }
        all = std::move(next);
    }
    if (family.cost_key.empty()) all.front().weight = 1000;
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
