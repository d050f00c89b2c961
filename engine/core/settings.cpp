#include "engine/core/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/core/check.h"
#include "engine/core/error.h"

namespace tyndall {
namespace {

using nlohmann::json;

/// What a person may write for it: the second half of every message about a value.
std::string allowed_values(const Setting& s) {
    switch (s.type) {
        case SettingType::boolean:
            return "true or false";
        case SettingType::choice:
            return fmt::format("one of {}", fmt::join(s.choices, ", "));
        case SettingType::integer:
            if (!s.allowed.empty()) return fmt::format("one of {}", fmt::join(s.allowed, ", "));
            return fmt::format("an integer from {} to {}", s.min, s.max);
        case SettingType::real:
            break;
    }
    return fmt::format("a number from {} to {}{}{}", s.min, s.max, s.unit.empty() ? "" : " ", s.unit);
}

UsageError bad_value(const Setting& s, std::string_view value) {
    return UsageError(fmt::format("setting {} = {:?}: {} expected", s.key, value, allowed_values(s)));
}

bool valid(const Setting& s, double value) {
    if (s.type == SettingType::real) {  // the nearest float to a bound may lie just outside of it
        return (value >= s.min && value <= s.max) || value == static_cast<float>(s.min) ||
               value == static_cast<float>(s.max);
    }
    if (!(value >= s.min && value <= s.max) || value != std::floor(value)) return false;
    return s.allowed.empty() || std::ranges::find(s.allowed, value) != s.allowed.end();
}

std::optional<double> choice_index(const Setting& s, std::string_view name) {
    const auto found = std::ranges::find(s.choices, name);
    if (found == s.choices.end()) return std::nullopt;
    return static_cast<double>(found - s.choices.begin());
}

std::optional<double> parse_number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

double parse_text(const Setting& s, std::string_view text) {
    std::optional<double> value;
    if (s.type == SettingType::choice) {
        value = choice_index(s, text);
    } else if (s.type == SettingType::boolean && (text == "true" || text == "on")) {
        value = 1;
    } else if (s.type == SettingType::boolean && (text == "false" || text == "off")) {
        value = 0;
    } else {
        value = parse_number(text);
    }
    if (!value || !valid(s, *value)) throw bad_value(s, text);
    return *value;
}

double parse_json(const Setting& s, const json& node) {
    std::optional<double> value;
    if (s.type == SettingType::boolean && node.is_boolean()) value = node.get<bool>() ? 1 : 0;
    if (s.type == SettingType::choice && node.is_string())
        value = choice_index(s, node.get_ref<const std::string&>());
    if ((s.type == SettingType::integer || s.type == SettingType::real) && node.is_number())
        value = node.get<double>();
    if (!value || !valid(s, *value)) {
        throw bad_value(s, node.is_string() ? node.get<std::string>()
                                            : node.dump(-1, ' ', false, json::error_handler_t::replace));
    }
    return *value;
}

std::string to_text(const Setting& s, double value) {
    switch (s.type) {
        case SettingType::boolean:
            return value != 0 ? "true" : "false";
        case SettingType::choice:
            return s.choices.at(static_cast<std::size_t>(value));
        case SettingType::integer:
            return fmt::format("{}", static_cast<long long>(value));
        case SettingType::real:
            break;
    }
    return fmt::format("{}", static_cast<float>(value));  // the shortest text that reads back as the same float
}

struct Found {
    const Setting* setting = nullptr;
    void* object = nullptr;
};

Found find(const std::vector<SettingsSet::Group>& groups, std::string_view key) {
    for (const SettingsSet::Group& group : groups) {
        for (const Setting& s : group.table->settings()) {
            if (s.key == key) return {&s, group.object};
        }
    }
    return {};
}

Found find_or_throw(const std::vector<SettingsSet::Group>& groups, std::string_view key) {
    const Found found = find(groups, key);
    if (found.setting == nullptr) throw UsageError(fmt::format("unknown setting {:?}", key));
    return found;
}

}  // namespace

Setting& SettingsTable::add_row(Text text, SettingType type, double min, double max, SettingScale scale,
                                SettingEffect effect) {
    Setting& row = settings_.emplace_back();
    row.key = std::move(text.key);
    row.label = std::move(text.label);
    row.help = std::move(text.help);
    row.unit = std::move(text.unit);
    row.type = type;
    row.min = min;
    row.max = max;
    row.scale = scale;
    row.effect = effect;
    return row;
}

void SettingsTable::add_choice(std::string_view key, std::string name) {
    const auto row = std::ranges::find(settings_, key, &Setting::key);
    TYNDALL_CHECK(row != settings_.end());
    row->choices.push_back(std::move(name));
    row->max = static_cast<double>(row->choices.size()) - 1;
}

double SettingsTable::index_of(const std::string& name, const std::vector<std::string>& names) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        throw Error(fmt::format("setting value '{}': expected one of {}", name, fmt::join(names, ", ")));
    return static_cast<double>(found - names.begin());
}

void SettingsSet::add(const SettingsTable& table, void* object) {
    const SettingsSet::Group added{&table, object};
    for (const Setting& s : table.settings()) {
        const bool key_is_new = find(groups_, s.key).setting == nullptr && find({added}, s.key).setting == &s;
        if (!key_is_new) detail::check_failed("key_is_new", s.key, __FILE__, __LINE__);
        if (!valid(s, s.default_value)) detail::check_failed("valid(default_value)", s.key, __FILE__, __LINE__);
    }
    groups_.push_back(added);
}

void SettingsSet::set(std::string_view key, std::string_view value) {
    const Found found = find_or_throw(groups_, key);
    found.setting->set(found.object, parse_text(*found.setting, value));
}

void SettingsSet::set(std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        throw UsageError(fmt::format("setting {:?}: key=value expected", assignment));
    }
    set(assignment.substr(0, equals), assignment.substr(equals + 1));
}

std::string SettingsSet::get(std::string_view key) const {
    const Found found = find_or_throw(groups_, key);
    return to_text(*found.setting, found.setting->get(found.object));
}

json SettingsSet::to_json() const {
    json object = json::object();
    for (const Group& group : groups_) {
        for (const Setting& s : group.table->settings()) {
            const double value = s.get(group.object);
            const std::string text = to_text(s, value);
            switch (s.type) {
                case SettingType::boolean:
                    object[s.key] = value != 0;
                    break;
                case SettingType::choice:
                    object[s.key] = text;
                    break;
                case SettingType::integer:
                    object[s.key] = static_cast<long long>(value);
                    break;
                case SettingType::real:
                    object[s.key] = parse_number(text).value();
                    break;
            }
        }
    }
    return object;
}

void SettingsSet::from_json(const json& object, std::string_view where) {
    if (!object.is_object()) throw Error(fmt::format("{}: an object of key: value expected", where));
    std::vector<std::pair<Found, double>> changes;
    try {
        for (const auto& [key, node] : object.items()) {
            const Found found = find_or_throw(groups_, key);
            changes.emplace_back(found, parse_json(*found.setting, node));
        }
    } catch (const UsageError& e) {
        throw Error(fmt::format("{}: {}", where, e.what()));
    }
    for (const auto& [found, value] : changes) found.setting->set(found.object, value);
}

void SettingsSet::reset_to_defaults() {
    for (const Group& group : groups_) {
        for (const Setting& s : group.table->settings()) s.set(group.object, s.default_value);
    }
}

}  // namespace tyndall
