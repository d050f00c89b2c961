#include "reference/sky_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace tyndall::reference {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int rows = 72, columns = 144;           // of each half
constexpr int patch_rows = 6, patch_columns = 8;  // cells of a patch
/// Elevation (rad) at which the sky model's eye, 300 m above a ground of radius 6360 km, sees the horizon.
const double horizon = -std::acos(6360 / 6360.3);

/// Of a half: from the horizon to the zenith or the nadir, rad.
double span(bool above) {
    return (above ? 0.5 : -0.5) * pi - horizon;
}

/// Sine of the elevation at `row` (0: horizon, rows: nadir or zenith). Its steps are solid angles.
double height(bool above, double row) {
    return std::sin(horizon + span(above) * std::pow(row / rows, 2));
}

dvec3 direction(double sine, double column) {
    const double azimuth = 2 * pi * column / columns, cosine = std::sqrt(std::max(1 - sine * sine, 0.0));
    return {cosine * std::cos(azimuth), sine, cosine * std::sin(azimuth)};
}

double solid_angle(bool above, int row) {
    return std::abs(height(above, row + 1) - height(above, row)) * 2 * pi / columns;
}

std::size_t cell(bool above, int row, int column) {
    return static_cast<std::size_t>((above ? rows + row : row) * columns + column);
}

/// The middles of all cells.
const std::vector<dvec3>& cell_directions() {
    static const std::vector<dvec3> directions = [] {
        std::vector<dvec3> list(2 * rows * columns);
        for (const bool above : {false, true})
            for (int row = 0; row < rows; ++row)
                for (int column = 0; column < columns; ++column)
                    list[cell(above, row, column)] = direction(height(above, row + 0.5), column + 0.5);
        return list;
    }();
    return directions;
}

/// One of the parts of a rising sum, and how far into it.
struct Drawn {
    int part;
    double within, share;  ///< share of the whole sum that the part has
};
Drawn draw(std::span<const double> sums, double u) {
    const double target = u * sums.back();
    const auto at = std::upper_bound(sums.begin(), sums.end() - 1, target);
    const double before = at == sums.begin() ? 0 : *std::prev(at), part = *at - before;
    return {static_cast<int>(at - sums.begin()), (target - before) / part, part / sums.back()};
}

}  // namespace

SkyTable::SkyTable(const std::function<dvec3(dvec3)>& radiance) : cells_(2 * rows * columns) {
    for (const bool above : {false, true})
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                cells_[cell(above, row, column)] = radiance(cell_directions()[cell(above, row, column)]);

    for (const bool above : {false, true})
        for (int row = 0; row < rows; row += patch_rows)
            for (int column = 0; column < columns; column += patch_columns) {
                Patch patch{dvec3(0), dvec3(0)};
                for (int i = row; i < row + patch_rows; ++i)
                    for (int j = column; j < column + patch_columns; ++j) {
                        const double part = solid_angle(above, i);
                        patch.direction += part * cell_directions()[cell(above, i, j)];
                        patch.flux += part * cells_[cell(above, i, j)];
                    }
                patch.direction = glm::normalize(patch.direction);
                patches_.push_back(patch);
            }
}

dvec3 SkyTable::at(dvec3 unit_direction) const {
    if (cells_.empty()) return dvec3(0);
    const double elevation = std::asin(std::clamp(unit_direction.y, -1.0, 1.0));
    const bool above = elevation >= horizon;
    const double share = (elevation - horizon) / span(above);
    const double y = std::clamp(rows * std::sqrt(std::clamp(share, 0.0, 1.0)) - 0.5, 0.0, rows - 1.0);
    const double x = columns * (std::atan2(unit_direction.z, unit_direction.x) / (2 * pi) + 1) - 0.5;
    const int row = std::min(static_cast<int>(y), rows - 2), column = static_cast<int>(x);
    const double down = y - row, right = x - column;
    const auto at = [&](int i, int j) { return cells_[cell(above, row + i, (column + j) % columns)]; };
    return (at(0, 0) * (1 - right) + at(0, 1) * right) * (1 - down) +
           (at(1, 0) * (1 - right) + at(1, 1) * right) * down;
}

dvec3 SkyTable::mean() const {
    dvec3 sum(0);
    for (const Patch& patch : patches_) sum += patch.flux;
    return sum / (4 * pi);
}

SkySampler::SkySampler(const SkyTable& table, const std::function<double(dvec3)>& lobe)
    : table_(&table), in_row_(table.cells_.size()) {
    double all = 0;
    for (std::size_t i = 0, row = 0; i < table.cells_.size(); ++row) {
        const double part = solid_angle(row >= rows, static_cast<int>(row % rows));
        double sum = 0;
        for (int column = 0; column < columns; ++column, ++i) {
            const dvec3& radiance = table.cells_[i];
            sum += part * (radiance.x + radiance.y + radiance.z) * lobe(cell_directions()[i]);
            in_row_[i] = sum;
        }
        all += sum;
        rows_.push_back(all);
    }
}

SkySampler::Sample SkySampler::at(double u, double v) const {
    if (rows_.empty() || !(rows_.back() > 0)) return {{0, 1, 0}, dvec3(0)};
    const Drawn row = draw(rows_, u);
    const Drawn column = draw(std::span(in_row_).subspan(static_cast<std::size_t>(row.part * columns), columns), v);
    const bool above = row.part >= rows;
    const int from_horizon = row.part % rows;
    const double sine = std::lerp(height(above, from_horizon), height(above, from_horizon + 1), row.within);
    const dvec3 towards = direction(sine, column.part + column.within);
    const double density = row.share * column.share / solid_angle(above, from_horizon);
    return {towards, table_->at(towards) / density};
}

}  // namespace tyndall::reference
