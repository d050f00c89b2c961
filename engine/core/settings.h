#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tyndall {

/// What a change of a setting costs: a new uniform value, new GPU resources, or another shader permutation.
enum class SettingEffect { uniform, resource, permutation };
enum class SettingScale { linear, logarithmic };
enum class SettingType { boolean, integer, real, choice };

/// One row of a settings table. The debug UI, JSON presets, `--set key=value`, range checks and the reference
/// docs are all made from these rows. Values travel as double: a boolean is 0 or 1, a choice is its index.
struct Setting {
    std::string key;    ///< unique over all tables: snake_case
    std::string label;  ///< for people
    std::string help;   ///< one sentence: what it does and what it costs
    std::string unit;   ///< "m", "1/m", "px", "" …
    SettingType type{};
    double min = 0;
    double max = 1;
    SettingScale scale = SettingScale::linear;
    SettingEffect effect = SettingEffect::uniform;
    std::vector<std::string> choices;  ///< of a choice, in enum order
    std::vector<double> allowed;       ///< if not empty, the only values an integer may take
    double default_value = 0;
    std::function<double(const void*)> get;
    std::function<void(void*, double)> set;
};

/// The table of a plain settings struct S: `SettingsTable t = SettingsTable::of<S>().real(&S::x, {...})…`.
class SettingsTable {
  public:
    struct Text {
        std::string key, label, help, unit = "";
    };

    explicit SettingsTable(std::string title) : title_(std::move(title)) {}

    template <class S>
    SettingsTable& boolean(bool S::*m, Text text, SettingEffect effect) {
        return add<S>(m, std::move(text), SettingType::boolean, 0, 1, SettingScale::linear, effect);
    }
    template <class S>
    SettingsTable& integer(int S::*m, Text text, int min, int max, SettingEffect effect,
                           SettingScale scale = SettingScale::linear) {
        return add<S>(m, std::move(text), SettingType::integer, min, max, scale, effect);
    }
    /// An integer that may take only the listed values, in rising order.
    template <class S>
    SettingsTable& integer_of(int S::*m, Text text, std::vector<double> allowed, SettingEffect effect) {
        add<S>(m, std::move(text), SettingType::integer, allowed.front(), allowed.back(), SettingScale::linear,
               effect);
        settings_.back().allowed = std::move(allowed);
        return *this;
    }
    template <class S>
    SettingsTable& real(float S::*m, Text text, double min, double max, SettingScale scale = SettingScale::linear,
                        SettingEffect effect = SettingEffect::uniform) {
        return add<S>(m, std::move(text), SettingType::real, min, max, scale, effect);
    }
    /// Enumerators must be 0, 1, 2 … in the order of `names`.
    template <class S, class Enum>
    SettingsTable& choice(Enum S::*m, Text text, std::vector<std::string> names, SettingEffect effect) {
        add<S>(m, std::move(text), SettingType::choice, 0, static_cast<double>(names.size()) - 1,
               SettingScale::linear, effect);
        settings_.back().choices = std::move(names);
        return *this;
    }
    /// One of `names`, held by name; the list may grow (add_choice).
    template <class S>
    SettingsTable& name(std::string S::*m, Text text, const std::vector<std::string>& (*names)(),
                        SettingEffect effect) {
        add<S>(std::move(text), SettingType::choice, 0, static_cast<double>(names().size()) - 1,
               SettingScale::linear, effect);
        Setting& row = settings_.back();
        row.choices = names();
        row.get = [m, names](const void* object) { return index_of(static_cast<const S*>(object)->*m, names()); };
        row.set = [m, names](void* object, double v) {
            static_cast<S*>(object)->*m = names().at(static_cast<std::size_t>(v));
        };
        const S defaults{};
        row.default_value = row.get(&defaults);
        return *this;
    }
    /// Another value of a choice that is held by name.
    void add_choice(std::string_view key, std::string name);

    [[nodiscard]] const std::string& title() const { return title_; }
    [[nodiscard]] const std::vector<Setting>& settings() const { return settings_; }

  private:
    /// Throws Error for a name that is not in the list.
    [[nodiscard]] static double index_of(const std::string& name, const std::vector<std::string>& names);
    template <class S>
    void add(Text text, SettingType type, double min, double max, SettingScale scale, SettingEffect effect) {
        Setting s;
        s.key = std::move(text.key);
        s.label = std::move(text.label);
        s.help = std::move(text.help);
        s.unit = std::move(text.unit);
        s.type = type;
        s.min = min;
        s.max = max;
        s.scale = scale;
        s.effect = effect;
        settings_.push_back(std::move(s));
    }
    template <class S, class T>
    SettingsTable& add(T S::*m, Text text, SettingType type, double min, double max, SettingScale scale,
                       SettingEffect effect) {
        add<S>(std::move(text), type, min, max, scale, effect);
        Setting& s = settings_.back();
        s.default_value = static_cast<double>(S{}.*m);
        s.get = [m](const void* object) { return static_cast<double>(static_cast<const S*>(object)->*m); };
        s.set = [m](void* object, double v) { static_cast<S*>(object)->*m = static_cast<T>(v); };
        return *this;
    }

    std::string title_;
    std::vector<Setting> settings_;
};

/// The settings of a program: tables bound to the structs they describe. Borrowed: both must outlive it.
class SettingsSet {
  public:
    struct Group {
        const SettingsTable* table;
        void* object;
    };

    /// Throws (a failed check) if a key is already taken.
    void add(const SettingsTable& table, void* object);

    [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }

    /// Sets from text, as in `--set key=value`. Booleans: true/false/1/0/on/off; choices by name.
    /// Throws UsageError naming the key, the value and the allowed range; nothing is changed then.
    void set(std::string_view key, std::string_view value);
    /// Splits "key=value" and sets it.
    void set(std::string_view assignment);
    /// The value as text, in the form `set` accepts. Throws UsageError for an unknown key.
    [[nodiscard]] std::string get(std::string_view key) const;

    /// A flat object of key: value for all settings (presets).
    [[nodiscard]] nlohmann::json to_json() const;
    /// Applies a flat object; keys not named keep their value. All or nothing; `where` (a path) starts the
    /// message of the Error it throws.
    void from_json(const nlohmann::json& object, std::string_view where);
    void reset_to_defaults();

  private:
    std::vector<Group> groups_;
};

}  // namespace tyndall
