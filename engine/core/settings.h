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

/// A member of a group within a settings struct: `in(&Settings::filter, &FilterSettings::sigma)`.
template <class S, class G, class T>
struct MemberIn {
    G S::*group;
    T G::*member;
    template <class Struct>
    auto& operator()(Struct& s) const {
        return s.*group.*member;
    }
};
template <class S, class G, class T>
[[nodiscard]] constexpr MemberIn<S, G, T> in(G S::*group, T G::*member) {
    return {group, member};
}

/// The table of a plain settings struct S: `SettingsTable("Title").real(&S::x, {...}).integer(in(&S::g, &G::n),
/// {...})`. A member is named by its pointer, or by `in` where it lies in a group.
class SettingsTable {
  public:
    struct Text {
        std::string key, label, help, unit = "";
    };

    explicit SettingsTable(std::string title) : title_(std::move(title)) {}

    template <class M>
    SettingsTable& boolean(M m, Text text, SettingEffect effect) {
        static_assert(std::is_same_v<ValueOf<M>, bool>);
        return add(m, std::move(text), SettingType::boolean, 0, 1, SettingScale::linear, effect);
    }
    template <class M>
    SettingsTable& integer(M m, Text text, int min, int max, SettingEffect effect,
                           SettingScale scale = SettingScale::linear) {
        static_assert(std::is_same_v<ValueOf<M>, int>);
        return add(m, std::move(text), SettingType::integer, min, max, scale, effect);
    }
    /// An integer that may take only the listed values, in rising order.
    template <class M>
    SettingsTable& integer_of(M m, Text text, std::vector<double> allowed, SettingEffect effect) {
        static_assert(std::is_same_v<ValueOf<M>, int>);
        add(m, std::move(text), SettingType::integer, allowed.front(), allowed.back(), SettingScale::linear,
            effect);
        settings_.back().allowed = std::move(allowed);
        return *this;
    }
    template <class M>
    SettingsTable& real(M m, Text text, double min, double max, SettingScale scale = SettingScale::linear,
                        SettingEffect effect = SettingEffect::uniform) {
        static_assert(std::is_same_v<ValueOf<M>, float>);
        return add(m, std::move(text), SettingType::real, min, max, scale, effect);
    }
    /// Enumerators must be 0, 1, 2 … in the order of `names`.
    template <class M>
    SettingsTable& choice(M m, Text text, std::vector<std::string> names, SettingEffect effect) {
        static_assert(std::is_enum_v<ValueOf<M>>);
        add(m, std::move(text), SettingType::choice, 0, static_cast<double>(names.size()) - 1, SettingScale::linear,
            effect);
        settings_.back().choices = std::move(names);
        return *this;
    }
    /// One of `names`, held by name; the list may grow (add_choice).
    template <class S>
    SettingsTable& name(std::string S::*m, Text text, const std::vector<std::string>& (*names)(),
                        SettingEffect effect) {
        Setting& row = add_row(std::move(text), SettingType::choice, 0, static_cast<double>(names().size()) - 1,
                               SettingScale::linear, effect);
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
    template <class S, class T>
    static S struct_of(T S::*);
    template <class S, class G, class T>
    static S struct_of(MemberIn<S, G, T>);
    template <class M>
    using StructOf = decltype(struct_of(std::declval<M>()));
    template <class M>
    using ValueOf = std::remove_cvref_t<std::invoke_result_t<M, StructOf<M>&>>;

    /// Throws Error for a name that is not in the list.
    [[nodiscard]] static double index_of(const std::string& name, const std::vector<std::string>& names);
    Setting& add_row(Text text, SettingType type, double min, double max, SettingScale scale, SettingEffect effect);
    template <class M>
    SettingsTable& add(M m, Text text, SettingType type, double min, double max, SettingScale scale,
                       SettingEffect effect) {
        using S = StructOf<M>;
        Setting& row = add_row(std::move(text), type, min, max, scale, effect);
        row.get = [m](const void* object) {
            return static_cast<double>(std::invoke(m, *static_cast<const S*>(object)));
        };
        row.set = [m](void* object, double v) {
            std::invoke(m, *static_cast<S*>(object)) = static_cast<ValueOf<M>>(v);
        };
        const S defaults{};
        row.default_value = row.get(&defaults);
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
