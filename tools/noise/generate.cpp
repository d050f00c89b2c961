#include "tools/noise/generate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <utility>

namespace tyndall::noise {
namespace {

constexpr int side = 128, depth = 32, slice = side * side;
constexpr int most_radius = 8;
constexpr int pitch = side + 2 * most_radius;  // of a row, with its wrapped ends
constexpr double unit = 1 << 12;               // of the kernels in fixed point

using Value = std::int16_t;

class Minimizer {
  public:
    explicit Minimizer(std::uint64_t seed) : random_(seed) {
        rows_.resize(static_cast<std::size_t>(depth) * side * pitch);
        lines_.resize(static_cast<std::size_t>(slice) * depth);
        for (int z = 0; z < depth; ++z) fill_slice(z);
    }

    void set(const Energy& energy) {
        radius_ = static_cast<int>(energy.space.size()) - 1;
        if (radius_ < 0 || radius_ > most_radius)
            throw std::invalid_argument("noise: 1 to 9 distances in space expected");
        if (!energy.time.empty() && energy.time.size() != depth)
            throw std::invalid_argument("noise: 32 distances in time expected");
        space_.clear();
        for (int y = -radius_; y <= radius_; ++y)
            for (int x = -radius_; x <= radius_; ++x)
                space_.push_back(x == 0 && y == 0 ? Value(0)
                                                  : fixed(energy.space[std::abs(x)] * energy.space[std::abs(y)]));
        // By absolute place in the line: time_[z + depth - z0].
        time_.assign(energy.time.empty() ? 0 : 2 * depth, 0);
        for (std::size_t i = 0; i < time_.size(); ++i) time_[i] = fixed(energy.time[i % depth]);
        if (!time_.empty()) time_[0] = time_[depth] = 0;
    }

    void sweep() {
        for (int i = 0; i < slice * depth; ++i) {
            const std::uint64_t r = random_();
            try_swap(static_cast<int>(r >> 28 & (depth - 1)), static_cast<int>(r & (slice - 1)),
                     static_cast<int>(r >> 14 & (slice - 1)));
        }
    }

    [[nodiscard]] Volume volume() const {
        Volume v{.side = side, .depth = depth};
        for (int z = 0; z < depth; ++z)
            for (int p = 0; p < slice; ++p) v.bytes.push_back(static_cast<std::uint8_t>(value(z, p)));
        return v;
    }

  private:
    static Value fixed(double k) { return static_cast<Value>(std::lround(k * unit)); }
    [[nodiscard]] const Value* row(int z, int y) const {
        return rows_.data() + (static_cast<std::ptrdiff_t>(z) * side + (y & (side - 1))) * pitch + most_radius;
    }
    [[nodiscard]] int value(int z, int p) const { return lines_[static_cast<std::size_t>(p) * depth + z]; }

    void put(int z, int p, int byte) {
        const int x = p % side;
        Value* to = rows_.data() + (static_cast<std::ptrdiff_t>(z) * side + p / side) * pitch + most_radius;
        to[x] = static_cast<Value>(byte);
        if (x < most_radius) to[x + side] = to[x];
        if (x >= side - most_radius) to[x - side] = to[x];
        lines_[static_cast<std::size_t>(p) * depth + z] = static_cast<Value>(byte);
    }

    void fill_slice(int z) {
        std::vector<int> bytes;
        for (int p = 0; p < slice; ++p) bytes.push_back(p % 256);
        for (int p = slice - 1; p > 0; --p) std::swap(bytes[p], bytes[random_() % static_cast<unsigned>(p + 1)]);
        for (int p = 0; p < slice; ++p) put(z, p, bytes[p]);
    }

    /// By how much a place's kernel sum of |v - v'| grows if its value becomes `to`.
    [[nodiscard]] int gain(int z, int p, int from, int to) const {
        const int x0 = p % side, y0 = p / side, width = 2 * radius_ + 1;
        int sum = 0;
        for (int y = 0; y < width; ++y) {
            const Value* k = space_.data() + static_cast<std::ptrdiff_t>(y) * width;
            const Value* v = row(z, y0 + y - radius_) + x0 - radius_;
            for (int x = 0; x < width; ++x) sum += k[x] * (std::abs(to - v[x]) - std::abs(from - v[x]));
        }
        if (time_.empty()) return sum;
        const Value* line = lines_.data() + static_cast<std::ptrdiff_t>(p) * depth;
        const Value* k = time_.data() + depth - z;
        for (int t = 0; t < depth; ++t) sum += k[t] * (std::abs(to - line[t]) - std::abs(from - line[t]));
        return sum;
    }

    /// Between two places of one slice.
    [[nodiscard]] int kernel(int a, int b) const {
        const auto distance = [](int p, int q) {
            const int d = std::abs(p - q);
            return std::min(d, side - d);
        };
        const int x = distance(a % side, b % side), y = distance(a / side, b / side);
        return x <= radius_ && y <= radius_ ? space_[(y + radius_) * (2 * radius_ + 1) + x + radius_] : 0;
    }

    void try_swap(int z, int a, int b) {
        const int first = value(z, a), second = value(z, b);
        if (first == second) return;
        // Either sum takes the other place as it was: their own pair keeps its difference.
        const int more =
            gain(z, a, first, second) + gain(z, b, second, first) + 2 * kernel(a, b) * std::abs(first - second);
        if (more <= 0) return;
        put(z, a, second);
        put(z, b, first);
    }

    std::mt19937_64 random_;
    int radius_ = 0;
    std::vector<Value> space_, time_;
    std::vector<Value> rows_, lines_;  // the values twice: along x, and along time
};

}  // namespace

Volume generate(const std::vector<Energy>& energies, std::uint64_t seed, int sweeps,
                const std::function<void(double)>& progress) {
    Minimizer minimizer(seed);
    const double all = static_cast<double>(energies.size()) * sweeps;
    double done = 0;
    for (const Energy& energy : energies) {
        minimizer.set(energy);
        for (int i = 0; i < sweeps; ++i) {
            minimizer.sweep();
            if (progress) progress(++done / all);
        }
    }
    return minimizer.volume();
}

}  // namespace tyndall::noise
