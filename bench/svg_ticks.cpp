#include <fmt/format.h>

#include <cmath>

#include "bench/svg_plot.h"

namespace tyndall::bench {
namespace {

/// From sparse to dense; the first that gives enough labels is taken.
const std::vector<std::vector<double>>& mantissas() {
    static const std::vector<std::vector<double>> sets{
        {1}, {1, 3}, {1, 2, 5}, {1, 2, 3, 4, 6, 8}, {1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7, 8, 9}};
    return sets;
}

std::string superscript(int value) {
    static const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : std::to_string(value)) text += c == '-' ? "⁻" : digits[c - '0'];
    return text;
}

}  // namespace

std::vector<double> log_ticks(double low, double high) {
    constexpr std::size_t enough = 4;
    std::vector<double> ticks;
    for (const std::vector<double>& set : mantissas()) {
        ticks.clear();
        for (double decade = std::floor(std::log10(low)); decade <= std::ceil(std::log10(high)); ++decade)
            for (const double mantissa : set) {
                const double value = mantissa * std::pow(10.0, decade);
                if (value >= low && value <= high) ticks.push_back(value);
            }
        if (ticks.size() >= enough) break;
    }
    return ticks;
}

std::string tick_text(double value) {
    if (value >= 0.99e-4 && value < 1e6) {
        std::string text = fmt::format("{:.6g}", value);
        if (value >= 10000) text.insert(text.size() - 3, ",");
        return text;
    }
    const int decade = static_cast<int>(std::floor(std::log10(value) + 1e-9));
    const double mantissa = value / std::pow(10.0, decade);
    const std::string power = "10" + superscript(decade);
    return std::abs(mantissa - 1) < 1e-6 ? power : fmt::format("{:.2g}·{}", mantissa, power);
}

}  // namespace tyndall::bench
