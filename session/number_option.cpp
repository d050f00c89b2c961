#include "session/number_option.h"

#include <fmt/format.h>

namespace tyndall {

CLI::Validator number_in(double low, double high) {
    const std::string range = fmt::format("a number from {} to {}", low, high);
    return {[=](const std::string& text) {
                double value = 0;
                const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
                return good ? std::string() : fmt::format("{}: {} expected", text, range);
            },
            range};
}

}  // namespace tyndall
