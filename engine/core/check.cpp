#include "engine/core/check.h"

#include <cstdio>
#include <cstdlib>

namespace tyndall::detail {

void check_failed(std::string_view expression, std::string_view values, const char* file, int line) {
    fmt::print(stderr, "{}:{}: check failed: {}{}{}{}\n", file, line, expression, values.empty() ? "" : " (",
               values, values.empty() ? "" : ")");
    std::abort();
}

}  // namespace tyndall::detail
