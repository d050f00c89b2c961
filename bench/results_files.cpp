#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "bench/pictures.h"
#include "bench/results.h"
#include "bench/techniques.h"

namespace tyndall::bench {

using nlohmann::json;

namespace {

using Fields = std::vector<std::pair<std::string, json>>;  // null: not measured

/// A row's values by column. Lengths of time in ms; work summed over the passes volumetrics/*.
Fields fields(const Suite& suite, const Row& row) {
    const Point& p = *row.point;
    const Measured& m = *row.measured;
    const Place& place = *p.place;
    Fields f{{"suite", suite.name},
             {"place", place.name},
             {"scene", place.scene},
             {"camera", place.camera},
             {"time_s", place.time},
             {"width", p.size.x},
             {"height", p.size.y},
             {"lamps", p.edit.lamps >= 0 ? p.edit.lamps : row.group->facts.lamps},
             {"spheres", p.edit.spheres >= 0 ? json(p.edit.spheres) : json()},
             {"variable", p.variable},
             {"value", p.value},
             {"family", p.configuration.family},
             {"settings", fmt::format("{}", fmt::join(p.configuration.settings, " "))}};
    const auto add = [&f](const char* name, bool known, double value) {
        f.emplace_back(name, known ? json(value) : json());
    };
    const bool timed = row.timed();
    f.emplace_back("samples", m.times.size());
    add("volumetrics_ms", timed, row.volumetrics.median);
    add("volumetrics_iqr_ms", timed, row.volumetrics.spread);
    add("volumetrics_least_ms", timed, row.volumetrics.least);
    add("frame_ms", timed, row.frame.median);
    add("frame_iqr_ms", timed, row.frame.spread);
    const Errors errors = m.errors.value_or(Errors{});
    const bool display = m.errors.has_value() && suite.display;
    add("scattering_relative_rmse", m.errors.has_value(), errors.scattering);
    add("scattering_relative_rmse_dim98", m.errors.has_value(), errors.dim);
    add("relative_rmse_at_depth_edges", m.errors.has_value(), errors.edge);
    add("relative_rmse_elsewhere", m.errors.has_value(), errors.rest);
    add("masked_pixels", m.errors.has_value(), errors.masked);
    add("transmittance_rmse", display, errors.transmittance);
    add("color_hdr_flip", display, errors.flip);
    add("invalid_values", m.errors.has_value(), errors.invalid);
    const Motion motion = m.motion.value_or(Motion{});
    add("flicker", m.motion.has_value(), motion.flicker);
    for (int i = 0; i < 3; ++i)
        add(fmt::format("residual_{}_frames", 1 << i).c_str(), m.motion.has_value(),
            motion.residual[std::size_t(i)]);
    for (int i = 0; i < static_cast<int>(gl::Work::count); ++i)
        f.emplace_back(gl::to_string(static_cast<gl::Work>(i)), m.work ? json((*m.work)[std::size_t(i)]) : json());
    return f;
}

/// RFC 4180: quoted where it must be.
std::string csv_text(const json& value) {
    if (value.is_null()) return "";
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    if (!value.is_string()) return value.dump();
    std::string text = value.get<std::string>();
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
    return '"' + text + '"';
}

std::string csv_line(const std::vector<std::string>& cells) {
    return fmt::format("{}\n", fmt::join(cells, ","));
}

}  // namespace

std::string results_csv(const Suite& suite, const std::vector<Row>& rows) {
    std::string csv;
    for (const Row& row : rows) {
        std::vector<std::string> names, values;
        for (const auto& [name, value] : fields(suite, row)) {
            names.push_back(name);
            values.push_back(csv_text(value));
        }
        if (csv.empty()) csv = csv_line(names);
        csv += csv_line(values);
    }
    return csv;
}

json results_json(const Suite& suite, const std::vector<Row>& rows, const json& conditions) {
    json list = json::array();
    for (const Row& row : rows) {
        json entry = json::object();
        for (const auto& [name, value] : fields(suite, row)) entry[name] = value;
        for (const auto& [pass, ms] : row.passes) entry["passes_ms"][pass] = ms;
        entry["label"] = row.point->configuration.label;
        if (row.compared()) {
            const PictureNames names = picture_names(row.point->key(), row.point->subject());
            entry["picture"] = names.light;
            entry["error_picture"] = names.error;
            entry["truth_picture"] = names.truth;
        }
        list.push_back(std::move(entry));
    }
    json looks = json::object();
    for (const Row& row : rows) {
        const Family& f = family(row.point->configuration.family);
        looks[f.name] = {{"color", f.color}, {"marker", static_cast<int>(f.marker)}};
    }
    return {{"title", suite.title}, {"conditions", conditions}, {"families", looks}, {"rows", list}};
}

}  // namespace tyndall::bench
