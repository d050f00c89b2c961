#include "bench/results.h"

#include <algorithm>
#include <map>

namespace tyndall::bench {
namespace {

void add_times(Row& row) {
    std::vector<double> volumetrics, frame;
    std::vector<std::string> order;
    std::map<std::string, std::vector<double>> passes;
    for (const PassTimes& times : row.measured->times) {
        volumetrics.push_back(0);
        frame.push_back(0);
        for (const auto& [pass, ms] : times) {
            frame.back() += ms;
            if (pass.starts_with("volumetrics/")) volumetrics.back() += ms;
            if (!passes.contains(pass)) order.push_back(pass);
            passes[pass].push_back(ms);
        }
    }
    row.volumetrics = median_spread(volumetrics);
    row.frame = median_spread(frame);
    for (const std::string& pass : order) row.passes.emplace_back(pass, median_spread(passes[pass]).median);
}

/// The configuration in terms that every place shares: without the rule for lamps.
std::string without_lamp_rule(const Configuration& c) {
    Configuration general = c;
    std::erase_if(general.settings, [](const std::string& s) { return s.starts_with("lamp_integration="); });
    return general.name();
}

}  // namespace

std::vector<Row> make_rows(const Suite& suite, const Store& store) {
    std::vector<Row> rows;
    for (const Group& group : suite.groups)
        for (const Point& point : group.points) {
            const Measured& m = store.at(point.key());
            if (m.times.empty() && !m.errors) continue;
            Row row{&group, &point, &m, {}, {}, {}};
            if (row.timed()) add_times(row);
            rows.push_back(std::move(row));
        }
    return rows;
}

std::vector<std::string> place_names(const std::vector<Row>& rows) {
    std::vector<std::string> names;
    for (const Row& row : rows)
        if (std::ranges::find(names, row.point->place->name) == names.end())
            names.push_back(row.point->place->name);
    return names;
}

std::vector<Row> of_place(const std::vector<Row>& rows, const std::string& place) {
    std::vector<Row> some;
    std::ranges::copy_if(rows, std::back_inserter(some),
                         [&](const Row& r) { return r.point->place->name == place; });
    return some;
}

std::vector<Mean> means(const std::vector<Row>& rows) {
    const std::size_t places = place_names(rows).size();
    std::map<std::string, std::vector<const Row*>> by_name, by_general_name;
    std::vector<const Point*> order;  // one point for each configuration
    for (const Row& row : rows) {
        if (!row.timed() || !row.compared()) continue;
        const Configuration& c = row.point->configuration;
        std::vector<const Row*>& same = by_name[c.name()];
        if (same.empty()) order.push_back(row.point);
        same.push_back(&row);
        if (without_lamp_rule(c) == c.name()) by_general_name[c.name()].push_back(&row);
    }
    std::vector<Mean> result;
    for (const Point* point : order) {
        const std::string name = point->configuration.name(), general = without_lamp_rule(point->configuration);
        std::vector<const Row*> all = by_name[name];
        if (general != name) {
            const auto& others = by_general_name[general];
            all.insert(all.end(), others.begin(), others.end());
        }
        if (all.size() != places) continue;
        std::vector<double> time, error, dim, flip;
        for (const Row* row : all) {
            time.push_back(row->volumetrics.median);
            error.push_back(row->measured->errors->scattering);
            dim.push_back(row->measured->errors->dim);
            flip.push_back(row->measured->errors->flip);
        }
        result.push_back(
            {point, geometric_mean(time), geometric_mean(error), geometric_mean(dim), geometric_mean(flip)});
    }
    return result;
}

}  // namespace tyndall::bench
