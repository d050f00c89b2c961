#pragma once

#include <nlohmann/json_fwd.hpp>

namespace tyndall {

class Session;

/// What a frame did: driver, passes (live or why not, milliseconds), work counts, memory; and what the time from
/// the program's start to its first frame went into.
[[nodiscard]] nlohmann::json stats_json(Session& session);

}  // namespace tyndall
