// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/formats/xyz_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pointrt {
namespace {

/// Three decimals a component leave a unit vector's length right to 0.001; two to 0.01.
constexpr double kUnitTolerance = 0.01;

bool isUnit(const double* v) {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return std::abs(length - 1) <= kUnitTolerance;
}

bool within(const ColumnStatistics& statistics, std::size_t first, double most) {
    for (std::size_t i = first; i < first + 3; ++i)
        if (!(statistics.least[i] >= 0 && statistics.most[i] <= most)) return false;
    return true;
}

bool wholeNumbers(const ColumnStatistics& statistics, std::size_t first) {
    return statistics.whole[first] && statistics.whole[first + 1] && statistics.whole[first + 2];
}

bool colorLike(const ColumnStatistics& statistics, std::size_t first) {
    return (wholeNumbers(statistics, first) && within(statistics, first, 65535)) || within(statistics, first, 1);
}

std::optional<std::size_t> findNormals(const ColumnStatistics& statistics, std::size_t extras) {
    for (std::size_t first = 0; first + 3 <= extras; ++first)
        if (statistics.unit[first]) return first;
    return std::nullopt;
}

/// Of "a b c d", d is an alpha where it is the same everywhere, as opaque clouds have it; else a is an intensity.
std::size_t firstColorOfFour(const ColumnStatistics& statistics) {
    const bool alpha_last =
        statistics.least[3] == statistics.most[3] && (statistics.most[3] == 255 || statistics.most[3] == 1);
    return alpha_last && colorLike(statistics, 0) ? 0 : 1;
}

std::optional<std::size_t> findColors(const ColumnStatistics& statistics, std::size_t extras,
                                      std::optional<std::size_t> normals) {
    if (extras == 4 && !normals) {
        const std::size_t first = firstColorOfFour(statistics);
        return colorLike(statistics, first) ? std::optional(first) : std::nullopt;
    }
    for (std::size_t first = 0; first + 3 <= extras; ++first) {
        const bool apart = !normals || first + 3 <= *normals || *normals + 3 <= first;
        if (apart && colorLike(statistics, first)) return first;
    }
    return std::nullopt;
}

void assign(std::vector<Role>& roles, std::size_t first, Role role) {
    for (int i = 0; i < 3; ++i) roles[first + i] = static_cast<Role>(role + i);
}

} // namespace

ColumnStatistics::ColumnStatistics() {
    whole.fill(true);
    unit.fill(true);
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
}

void observe(ColumnStatistics& statistics, const double* extras, std::size_t count) {
    count = std::min(count, ColumnStatistics::kMax);
    for (std::size_t i = 0; i < count; ++i) {
        const double value = extras[i];
        statistics.whole[i] = statistics.whole[i] && value == std::trunc(value);
        statistics.least[i] = std::min(statistics.least[i], value);
        statistics.most[i] = std::max(statistics.most[i], value);
        statistics.unit[i] = statistics.unit[i] && i + 3 <= count && isUnit(extras + i);
    }
}

ColumnGuess guessColumns(const ColumnStatistics& statistics, std::size_t column_count) {
    ColumnGuess guess;
    guess.roles.assign(column_count, kIgnored);
    assign(guess.roles, 0, kX);
    if (column_count != 6 && column_count != 7 && column_count != 9 && column_count != 10) return guess;
    const std::size_t extras = column_count - 3;
    const auto normals = findNormals(statistics, extras);
    const auto colors = findColors(statistics, extras, normals);
    if (normals) assign(guess.roles, 3 + *normals, kNormalX);
    if (colors) {
        assign(guess.roles, 3 + *colors, kRed);
        guess.real_colors = !wholeNumbers(statistics, *colors);
    }
    return guess;
}

} // namespace pointrt
