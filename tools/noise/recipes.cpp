#include "tools/noise/recipes.h"

#include <algorithm>
#include <cmath>

#include "tools/noise/filters.h"

namespace tyndall::noise {
namespace {

std::vector<double> relative_to_first(std::vector<double> values) {
    const double first = values.front();
    for (double& v : values) v /= first;
    return values;
}

double gaussian(double distance, double sigma) {
    return std::exp(-distance * distance / (2 * sigma * sigma));
}

/// In space sigma = 1: wider energies leave more of what a filter of a few pixels lets through.
Energy void_and_cluster(double sigma_time, double weight_time) {
    Energy energy;
    for (int d = 0; d <= 6; ++d) energy.space.push_back(gaussian(d, 1));
    for (int d = 0; weight_time > 0 && d < 32; ++d)
        energy.time.push_back(weight_time * gaussian(std::min(d, 32 - d), sigma_time));
    return energy;
}

}  // namespace

const std::vector<Recipe>& recipes() {
    static const std::vector<Recipe> list = [] {
        std::uint64_t seed = 1;
        std::vector<Recipe> all{{"blue", {void_and_cluster(1, 0)}, seed++},
                                {"stbn", {void_and_cluster(1.9, 2)}, seed++}};
        for (const std::string& time : temporal_filter_names())
            for (const std::string& space : spatial_filter_names())
                all.push_back({"fast_" + time + "_" + space,
                               {void_and_cluster(1, 1),
                                {relative_to_first(autocorrelation(spatial_taps(space))),
                                 relative_to_first(cyclic_autocorrelation(temporal_taps(time, 32)))}},
                               seed++});
        return all;
    }();
    return list;
}

}  // namespace tyndall::noise
