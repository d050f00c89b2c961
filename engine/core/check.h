#pragma once

#include <fmt/format.h>

#include <string_view>

namespace tyndall::detail {
[[noreturn]] void check_failed(std::string_view expression, std::string_view values, const char* file, int line);
}

/// Programming errors: print the expression (and both values) and abort. Active in every build type.
#define TYNDALL_CHECK(condition) \
    ((condition) ? void() : ::tyndall::detail::check_failed(#condition, "", __FILE__, __LINE__))
#define TYNDALL_CHECK_OP(a, op, b)                                                                          \
    do {                                                                                                    \
        const auto& check_a_ = (a);                                                                         \
        const auto& check_b_ = (b);                                                                         \
        if (!(check_a_ op check_b_))                                                                        \
            ::tyndall::detail::check_failed(#a " " #op " " #b, fmt::format("{} vs {}", check_a_, check_b_), \
                                            __FILE__, __LINE__);                                            \
    } while (false)
#define TYNDALL_CHECK_EQ(a, b) TYNDALL_CHECK_OP(a, ==, b)
#define TYNDALL_CHECK_LT(a, b) TYNDALL_CHECK_OP(a, <, b)
#define TYNDALL_CHECK_LE(a, b) TYNDALL_CHECK_OP(a, <=, b)
