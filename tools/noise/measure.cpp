#include "tools/noise/measure.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "tools/noise/filters.h"

namespace tyndall::noise {
namespace {

std::vector<double> centred(const Volume& volume) {
    double mean = 0;
    for (const std::uint8_t b : volume.bytes) mean += b;
    mean /= static_cast<double>(volume.size());
    std::vector<double> v;
    for (const std::uint8_t b : volume.bytes) v.push_back(b - mean);
    return v;
}

double sum_of_squares(const std::vector<double>& v) {
    double sum = 0;
    for (const double x : v) sum += x * x;
    return sum;
}

// Along one axis of `count` values `stride` apart. The lines along it lie side by side in memory, so they are the
// innermost loop.

/// Wrapping: out(i) = sum_j taps[j] in(i - j + centre); `count` is a power of two.
std::vector<double> filter(const std::vector<double>& in, const std::vector<double>& taps, std::size_t count,
                           std::size_t stride, std::size_t centre) {
    std::vector<double> out(in.size(), 0.0);
    for (std::size_t begin = 0; begin < in.size(); begin += count * stride)
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < taps.size(); ++j) {
                double* to = out.data() + begin + i * stride;
                const double* from = in.data() + begin + ((i + count - j + centre) & (count - 1)) * stride;
                for (std::size_t line = 0; line < stride; ++line) to[line] += taps[j] * from[line];
            }
    return out;
}

/// Fourier: out(k) = sum_j in(j) exp(-2 pi i j k / count); `count` is a power of two.
std::vector<std::complex<double>> transform(const std::vector<std::complex<double>>& in, std::size_t count,
                                            std::size_t stride) {
    std::vector<std::complex<double>> turns, out(in.size());
    for (std::size_t i = 0; i < count; ++i)
        turns.push_back(
            std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count)));
    for (std::size_t begin = 0; begin < in.size(); begin += count * stride)
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t j = 0; j < count; ++j) {
                const double re = turns[j * k & (count - 1)].real(), im = turns[j * k & (count - 1)].imag();
                std::complex<double>* to = out.data() + begin + k * stride;
                const std::complex<double>* from = in.data() + begin + j * stride;
                // Not by operator*, which looks for infinities.
                for (std::size_t line = 0; line < stride; ++line)
                    to[line] += std::complex(from[line].real() * re - from[line].imag() * im,
                                             from[line].real() * im + from[line].imag() * re);
            }
    return out;
}

}  // namespace

double filtered_variance(const Volume& volume, const std::string& spatial, const std::string& temporal) {
    const auto side = static_cast<std::size_t>(volume.side), depth = static_cast<std::size_t>(volume.depth);
    std::vector<double> v = centred(volume);
    const double before = sum_of_squares(v);
    double white = 1;
    if (!spatial.empty()) {
        const std::vector<double> taps = spatial_taps(spatial);
        v = filter(filter(v, taps, side, 1, taps.size() / 2), taps, side, side, taps.size() / 2);
        white *= sum_of_squares(taps) * sum_of_squares(taps);
    }
    if (!temporal.empty()) {
        const std::vector<double> taps = temporal_taps(temporal, volume.depth);
        v = filter(v, taps, depth, side * side, 0);
        white *= sum_of_squares(taps);
    }
    return sum_of_squares(v) / before / white;
}

bool has_uniform_slices(const Volume& volume) {
    for (int z = 0; z < volume.depth; ++z) {
        std::array<std::size_t, 256> counts{};
        for (std::size_t i = 0; i < volume.slice_size(); ++i) ++counts[volume.bytes[z * volume.slice_size() + i]];
        for (const std::size_t count : counts)
            if (count != volume.slice_size() / 256) return false;
    }
    return true;
}

std::vector<double> spatial_spectrum(const Volume& volume) {
    const auto side = static_cast<std::size_t>(volume.side);
    const std::vector<double> v = centred(volume);
    const std::vector<std::complex<double>> plane = transform(transform({v.begin(), v.end()}, side, 1), side, side);
    std::vector<double> power(side / 2, 0.0), counts(side / 2, 0.0);
    const auto signed_frequency = [&](std::size_t k) {
        return static_cast<double>(k) - (k > side / 2 ? static_cast<double>(side) : 0.0);
    };
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const double fx = signed_frequency(i % side), fy = signed_frequency(i / side % side);
        const auto ring = static_cast<std::size_t>(std::hypot(fx, fy));
        if (ring >= power.size() || (fx == 0 && fy == 0)) continue;
        power[ring] += std::norm(plane[i]);
        ++counts[ring];
    }
    const double white = sum_of_squares(v) / static_cast<double>(v.size()) * static_cast<double>(side * side);
    for (std::size_t k = 0; k < power.size(); ++k) power[k] = counts[k] > 0 ? power[k] / counts[k] / white : 0;
    return power;
}

std::vector<double> temporal_spectrum(const Volume& volume) {
    const auto depth = static_cast<std::size_t>(volume.depth);
    const std::vector<double> v = centred(volume);
    const std::vector<std::complex<double>> lines = transform({v.begin(), v.end()}, depth, volume.slice_size());
    std::vector<double> power;
    const double white = sum_of_squares(v) / static_cast<double>(v.size()) * static_cast<double>(depth);
    for (std::size_t k = 1; k <= depth / 2; ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < volume.slice_size(); ++i) sum += std::norm(lines[k * volume.slice_size() + i]);
        power.push_back(sum / static_cast<double>(volume.slice_size()) / white);
    }
    return power;
}

}  // namespace tyndall::noise
