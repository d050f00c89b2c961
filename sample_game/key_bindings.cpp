#include "sample_game/key_bindings.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <utility>

namespace tyndall {
namespace {

/// The README's other keys in the game.
bool is_own(Key key) {
    const auto between = [&](Key first, Key last) { return key >= first && key <= last; };
    return between(Key::f1, Key::f12) || between(Key::num_1, Key::num_7) || between(Key::left, Key::down) ||
           key == Key::escape || key == Key::control || key == Key::f || key == Key::g || key == Key::h ||
           key == Key::t || key == Key::v;
}

std::string own_key_problem(Key key) {
    return is_own(key) ? key_label(key) + " is a key of the game's own" : std::string();
}

Key key_of(const Setting& row, const KeyBindings& keys) {
    return static_cast<Key>(static_cast<int>(row.get(&keys)));
}

constexpr std::array<std::pair<const char*, const char*>, 8> gamepad_labels{{{"{forward}", "Left stick"},
                                                                             {"{back}", "Left stick"},
                                                                             {"{left}", "Left stick"},
                                                                             {"{right}", "Left stick"},
                                                                             {"{run}", "Right trigger"},
                                                                             {"{jump}", "A"},
                                                                             {"{lantern}", "B"},
                                                                             {"{use}", "X"}}};

void replace(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

}  // namespace

const SettingsTable& key_bindings_table() {
    using K = KeyBindings;
    static const SettingsTable table = [] {
        SettingsTable t("Keys");
        const auto row = [&](Key K::*member, const char* key, const char* label, const char* help) {
            t.choice(member, {key, label, help}, key_names(), SettingEffect::uniform);
        };
        row(&K::forward, "key_forward", "Forward", "Walks or flies on.");
        row(&K::back, "key_back", "Back", "Walks or flies backwards.");
        row(&K::left, "key_left", "Left", "Steps to the left.");
        row(&K::right, "key_right", "Right", "Steps to the right.");
        row(&K::run, "key_run", "Run", "While it is held, walks and flies faster.");
        row(&K::jump, "key_jump", "Jump", "Jumps; rises while flying.");
        row(&K::lantern, "key_lantern", "Lantern", "Lights the lantern, or puts it out.");
        row(&K::use, "key_use", "Use", "Lights the lamp one stands at.");
        return t;
    }();
    return table;
}

std::string problem_of(const KeyBindings& keys) {
    const auto& rows = key_bindings_table().settings();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Key key = key_of(rows[i], keys);
        if (is_own(key)) return fmt::format("{}: {}", rows[i].key, own_key_problem(key));
        for (std::size_t k = 0; k < i; ++k)
            if (key_of(rows[k], keys) == key)
                return fmt::format("{} and {} are both {}", rows[k].key, rows[i].key, key_label(key));
    }
    return {};
}

std::string rebind(KeyBindings& keys, const Setting& row, Key key) {
    if (is_own(key)) return own_key_problem(key);
    for (const Setting& other : key_bindings_table().settings())
        if (key_of(other, keys) == key) other.set(&keys, row.get(&keys));
    row.set(&keys, static_cast<double>(key));
    return {};
}

std::string key_label(Key key) {
    std::string label = key_names().at(static_cast<std::size_t>(key));
    label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    replace(label, "_", " ");
    return label;
}

std::string with_keys(std::string text, const KeyBindings& keys, bool gamepad) {
    if (gamepad)
        for (const auto& [name, button] : gamepad_labels) replace(text, name, button);
    for (const Setting& row : key_bindings_table().settings())
        replace(text, "{" + row.key.substr(4) + "}", key_label(key_of(row, keys)));
    return text;
}

}  // namespace tyndall
