#include "tools/noise/filters.h"

#include <cmath>
#include <stdexcept>

namespace tyndall::noise {
namespace {

std::vector<double> normalized(std::vector<double> taps) {
    double sum = 0;
    for (const double tap : taps) sum += tap;
    for (double& tap : taps) tap /= sum;
    return taps;
}

}  // namespace

std::vector<double> spatial_taps(const std::string& name) {
    if (name == "box3") return normalized({1, 1, 1});
    if (name == "box5") return normalized({1, 1, 1, 1, 1});
    if (name == "binomial3") return normalized({1, 2, 1});
    if (name == "binomial5") return normalized({1, 4, 6, 4, 1});
    if (name == "gaussian1") {
        std::vector<double> taps;
        for (int x = -4; x <= 4; ++x) taps.push_back(std::exp(-0.5 * x * x));
        return normalized(taps);
    }
    throw std::invalid_argument("spatial filter '" + name + "'");
}

std::vector<double> temporal_taps(const std::string& name, int depth) {
    std::vector<double> taps(static_cast<std::size_t>(depth), 0.0);
    for (std::size_t i = 0; i < taps.size(); ++i) {
        if (name == "ema")
            taps[i] = std::pow(0.9, static_cast<double>(i));
        else if (name == "box8")
            taps[i] = i < 8 ? 1 : 0;
        else
            throw std::invalid_argument("temporal filter '" + name + "'");
    }
    return normalized(taps);
}

const std::vector<std::string>& spatial_filter_names() {
    static const std::vector<std::string> names{"gaussian1", "box3", "box5", "binomial3", "binomial5"};
    return names;
}

const std::vector<std::string>& temporal_filter_names() {
    static const std::vector<std::string> names{"ema", "box8"};
    return names;
}

std::vector<double> autocorrelation(const std::vector<double>& taps) {
    std::vector<double> result(taps.size(), 0.0);
    for (std::size_t d = 0; d < taps.size(); ++d)
        for (std::size_t i = 0; i + d < taps.size(); ++i) result[d] += taps[i] * taps[i + d];
    return result;
}

std::vector<double> cyclic_autocorrelation(const std::vector<double>& taps) {
    std::vector<double> result(taps.size(), 0.0);
    for (std::size_t d = 0; d < taps.size(); ++d)
        for (std::size_t i = 0; i < taps.size(); ++i) result[d] += taps[i] * taps[(i + d) % taps.size()];
    return result;
}

}  // namespace tyndall::noise
