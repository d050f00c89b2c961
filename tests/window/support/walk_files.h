#pragma once

#include <nlohmann/json.hpp>

namespace tyndall::test {

/// A walk between two lamps, at (0, 1, 5) and (0, 1, -5).
[[nodiscard]] nlohmann::json walk_of_two_lamps();

}  // namespace tyndall::test
