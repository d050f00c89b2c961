#pragma once

#include <nlohmann/json_fwd.hpp>

namespace tyndall {

class Session;

/// What a frame did: driver, passes (live or why not, milliseconds), work counts, memory.
[[nodiscard]] nlohmann::json stats_json(Session& session);

}  // namespace tyndall
