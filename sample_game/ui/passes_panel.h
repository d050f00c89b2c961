#pragma once

#include "session/session.h"

namespace tyndall {

/// Times and work counts per pass, and the whole pass list with what did not run and why.
void passes_panel(Session& session);
/// Sum of the times of the passes whose name starts with `prefix`, ms, from the last frame that was timed.
[[nodiscard]] double pass_milliseconds(const Renderer& renderer, const std::string& prefix);

}  // namespace tyndall
