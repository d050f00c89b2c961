#pragma once

#include <fmt/format.h>

#include <source_location>

#include "engine/core/check.h"

namespace tyndall::detail {

/// A failed check that says what was expected and names the resource or pass it is about.
inline void require(bool ok, std::string_view expected, std::string_view name,
                    std::source_location where = std::source_location::current()) {
    if (!ok) check_failed(expected, fmt::format("'{}'", name), where.file_name(), static_cast<int>(where.line()));
}

}  // namespace tyndall::detail
