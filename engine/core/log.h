#pragma once

#include <spdlog/spdlog.h>

/// Logging is spdlog's default logger, sent to stderr: stdout belongs to the commands' results.
namespace tyndall {
void init_logging(bool verbose = false);
}
