#pragma once

#include <string>

#include "engine/core/settings.h"
#include "engine/platform/input.h"

namespace tyndall {

/// What a player may choose keys for. The game's other keys (README) stay as they are.
struct KeyBindings {
    Key forward = Key::w, back = Key::s, left = Key::a, right = Key::d, run = Key::shift, jump = Key::space,
        lantern = Key::r, use = Key::e;
    bool operator==(const KeyBindings&) const = default;
};
[[nodiscard]] const SettingsTable& key_bindings_table();

/// Why they cannot be used, in one line: a key for two things, or one that is the game's own; else empty.
[[nodiscard]] std::string problem_of(const KeyBindings& keys);
/// Gives a row of the table another key; what had it gets the row's old one. Nothing changes, and why is returned,
/// for a key that is the game's own.
std::string rebind(KeyBindings& keys, const Setting& row, Key key);

/// As people read it: "W", "Page up".
[[nodiscard]] std::string key_label(Key key);
/// Replaces "{use}", "{lantern}" and so on, without the table's "key_", by the labels of the keys, or those that a
/// gamepad has by its buttons.
[[nodiscard]] std::string with_keys(std::string text, const KeyBindings& keys, bool gamepad);

}  // namespace tyndall
