#include "reference/cube_quadrature.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace tyndall::reference {
namespace {

using glm::dvec3;

/// Steele, Lea and Flood 2014: the finaliser of SplitMix64.
std::uint64_t mixed(std::uint64_t h) {
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9;
    h = (h ^ (h >> 27)) * 0x94d049bb133111eb;
    return h ^ (h >> 31);
}

constexpr std::uint32_t reversed(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555) | ((x & 0x55555555) << 1);
    x = ((x >> 2) & 0x33333333) | ((x & 0x33333333) << 2);
    x = ((x >> 4) & 0x0f0f0f0f) | ((x & 0x0f0f0f0f) << 4);
    x = ((x >> 8) & 0x00ff00ff) | ((x & 0x00ff00ff) << 8);
    return (x >> 16) | (x << 16);
}

/// Sobol's points (1967), of which any 2^k in a row are spread evenly, scrambled as Owen does by a hash (Laine and
/// Karras 2011, constants of Vegdahl 2021) of a seed and of `which` set it is.
class Points {
  public:
    Points(dvec3 seed, std::uint64_t which) {
        constexpr std::uint64_t weyl = 0x9e3779b97f4a7c15;
        std::uint64_t h = which;
        for (int c = 0; c < 3; ++c) h = mixed(h + std::bit_cast<std::uint64_t>(seed[c]) + weyl);
        for (std::uint32_t& scramble : scrambles_) scramble = static_cast<std::uint32_t>(h = mixed(h + weyl));
    }
    dvec3 next() {
        dvec3 point(0);
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint32_t x = 0;
            for (std::uint32_t bits = index_, k = 0; bits != 0; bits >>= 1, ++k)
                if (bits & 1) x ^= directions[c][k];
            x = reversed(x) + scrambles_[c];
            for (const std::uint32_t factor : {0x6c50b47cu, 0xb82f1e52u, 0xc7afe638u, 0x8d22f6e6u}) x ^= x * factor;
            point[static_cast<int>(c)] = reversed(x) * 0x1p-32;
        }
        ++index_;
        return point;
    }

  private:
    /// Of the polynomials 1, x + 1 and x² + x + 1 (Joe and Kuo 2008).
    static constexpr std::array<std::array<std::uint32_t, 32>, 3> directions = [] {
        std::array<std::array<std::uint32_t, 32>, 3> v{};
        v[0][0] = v[1][0] = v[2][0] = 0x80000000;
        v[2][1] = 0xc0000000;
        for (std::size_t k = 1; k < 32; ++k) {
            v[0][k] = v[0][k - 1] >> 1;
            v[1][k] = v[1][k - 1] ^ (v[1][k - 1] >> 1);
            if (k > 1) v[2][k] = v[2][k - 1] ^ v[2][k - 2] ^ (v[2][k - 2] >> 2);
        }
        return v;
    }();
    std::array<std::uint32_t, 3> scrambles_{};
    std::uint32_t index_ = 0;
};

constexpr std::size_t rows = 16, columns = 24;  ///< cells in y and z

/// How densely the points lie, cell by cell.
class Density {
  public:
    explicit Density(std::size_t layers)
        : tried_(layers * rows * columns), squares_(tried_.size()), shares_(tried_.size(), 1) {
        sum_up();
    }

    struct Point {
        dvec3 at;
        double weight;  ///< 1 over the density
        std::size_t cell;
    };
    [[nodiscard]] Point at(dvec3 u) const {
        const Drawn layer = draw(layers_, u.x);
        const Drawn row = draw(std::span(rows_).subspan(layer.part * rows, rows), u.y);
        const std::size_t line = layer.part * rows + row.part;
        const Drawn column = draw(std::span(shares_).subspan(line * columns, columns), u.z);
        const std::size_t cell = line * columns + column.part;
        return {{layer.position(layers_.size()), row.position(rows), column.position(columns)},
                1 / shares_[cell],
                cell};
    }
    void learn(const Point& point, dvec3 value) {
        tried_[point.cell] += 1;
        squares_[point.cell] += std::pow(value.x + value.y + value.z, 2);
    }
    /// What is drawn from now on lies where the root mean square was great around.
    void adapt() {
        constexpr double anywhere = 0.25;  // of the points: evenly
        const double square = sum(squares_) / sum(tried_);
        if (!(square > 0)) return;
        for (std::size_t i = 0; i < shares_.size(); ++i)
            shares_[i] = std::sqrt((around(squares_, i) + square) / (around(tried_, i) + 1));
        const double mean = sum(shares_) / static_cast<double>(shares_.size());
        for (double& share : shares_) share = anywhere + (1 - anywhere) * share / mean;
        sum_up();
    }

  private:
    /// One of the parts of a sum, and how far into it.
    struct Drawn {
        std::size_t part;
        double within;
        [[nodiscard]] double position(std::size_t parts) const {
            return (static_cast<double>(part) + within) / static_cast<double>(parts);
        }
    };
    static double sum(std::span<const double> parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }
    static Drawn draw(std::span<const double> parts, double u) {
        double left = u * sum(parts);
        std::size_t i = 0;
        while (i + 1 < parts.size() && left >= parts[i]) left -= parts[i++];
        return {i, std::min(left / parts[i], 1.0)};
    }
    /// Sum over a cell and its neighbours.
    [[nodiscard]] double around(const std::vector<double>& values, std::size_t cell) const {
        const std::size_t layer = cell / (rows * columns), row = cell / columns % rows, column = cell % columns;
        const auto before = [](std::size_t i) { return i > 0 ? i - 1 : 0; };
        double sum = 0;
        for (std::size_t l = before(layer); l <= std::min(layer + 1, layers_.size() - 1); ++l)
            for (std::size_t r = before(row); r <= std::min(row + 1, rows - 1); ++r)
                for (const std::size_t c : {column + columns - 1, column, column + 1})
                    sum += values[(l * rows + r) * columns + c % columns];
        return sum;
    }
    void sum_up() {
        rows_.assign(shares_.size() / columns, 0);
        layers_.assign(rows_.size() / rows, 0);
        for (std::size_t i = 0; i < shares_.size(); ++i) {
            rows_[i / columns] += shares_[i];
            layers_[i / columns / rows] += shares_[i];
        }
    }

    std::vector<double> tried_, squares_, shares_;  ///< of each cell; shares: 1 on the mean
    std::vector<double> rows_, layers_;             ///< sums of the shares
};

}  // namespace

CubeIntegral integrate_cube(const std::function<dvec3(dvec3)>& f, std::size_t layers, int samples, dvec3 seed) {
    constexpr int parts = 16;
    Density density(layers);
    Points first(seed, 0);
    for (int i = 0; i < samples / 4; ++i) {
        const Density::Point point = density.at(first.next());
        density.learn(point, f(point.at));
    }
    density.adapt();
    // A set that knows nothing of the first: where those were crowded by chance, these must not be sparse.
    Points points(seed, 1);
    std::array<dvec3, parts> means{};
    dvec3 sum(0);
    for (int part = 0, i = 0; part < parts; ++part) {
        const int begin = i, end = static_cast<int>(std::int64_t{samples} * (part + 1) / parts);
        dvec3 of_part(0);
        for (; i < end; ++i) {
            const Density::Point point = density.at(points.next());
            of_part += point.weight * f(point.at);
        }
        sum += of_part;
        means[static_cast<std::size_t>(part)] = of_part / static_cast<double>(end - begin);
    }
    const dvec3 mean = sum / static_cast<double>(samples);
    dvec3 variance(0);
    for (const dvec3& m : means) variance += (m - mean) * (m - mean) / (parts * (parts - 1.0));
    return {mean, glm::sqrt(variance)};
}

}  // namespace tyndall::reference
