// SPDX-License-Identifier: Apache-2.0
// Circles and spheres fitted to points of 2 or 3 coordinates, by one method.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace pointrt {

template <std::size_t Size>
using Row = std::array<double, Size>;

/// Solves m x = b by Gaussian elimination with pivoting. Nullopt if m is singular to rounding.
template <std::size_t Size>
std::optional<Row<Size>> solveLinear(std::array<Row<Size>, Size> m, Row<Size> b) {
    constexpr double kSingular = 1e-12; // of pivots of equations whose largest coefficients are about 1
    for (std::size_t k = 0; k < Size; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < Size; ++i)
            if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
        std::swap(m[k], m[pivot]);
        std::swap(b[k], b[pivot]);
        if (!(std::abs(m[k][k]) > kSingular)) return std::nullopt;
        for (std::size_t i = k + 1; i < Size; ++i) {
            const double factor = m[i][k] / m[k][k];
            for (std::size_t j = k; j < Size; ++j) m[i][j] -= factor * m[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = Size; k-- > 0;) {
        for (std::size_t j = k + 1; j < Size; ++j) b[k] -= m[k][j] * b[j];
        b[k] /= m[k][k];
    }
    return b;
}

/// A circle or sphere.
template <std::size_t Dimensions>
struct Round {
    Row<Dimensions> center{};
    double radius = 0;
};

/// Solves the normal equations of rows(point) -> (coefficients, right side), divided by the number of points.
template <std::size_t Size, typename Points, typename RowOf>
std::optional<Row<Size>> leastSquares(const Points& points, const RowOf& rowOf) {
    std::array<Row<Size>, Size> m{};
    Row<Size> b{};
    for (const auto& point : points) {
        const auto [coefficients, right] = rowOf(point);
        for (std::size_t i = 0; i < Size; ++i) {
            for (std::size_t j = 0; j < Size; ++j)
                m[i][j] += coefficients[i] * coefficients[j] / static_cast<double>(points.size());
            b[i] += coefficients[i] * right / static_cast<double>(points.size());
        }
    }
    return solveLinear<Size>(m, b);
}

/// The circle or sphere with the least sum of squared distances from the points: started from the algebraic fit, which
/// is linear (Kasa 1976) but too small for noisy arcs, then improved by Gauss-Newton steps. Nullopt if the points lie
/// on a line (circle) or in a plane (sphere).
/// @param points around 0, of a size of about 1
template <std::size_t Dimensions>
std::optional<Round<Dimensions>> fitRound(std::span<const Row<Dimensions>> points) {
    constexpr std::size_t kUnknowns = Dimensions + 1;
    const auto algebraic = leastSquares<kUnknowns>(points, [](const Row<Dimensions>& point) {
        Row<kUnknowns> row{};
        double square = 0;
        for (std::size_t k = 0; k < Dimensions; ++k) {
            row[k] = 2 * point[k];
            square += point[k] * point[k];
        }
        row[Dimensions] = 1;
        return std::pair(row, square);
    });
    if (!algebraic) return std::nullopt;
    Round<Dimensions> round;
    double square = (*algebraic)[Dimensions];
    for (std::size_t k = 0; k < Dimensions; ++k) {
        round.center[k] = (*algebraic)[k];
        square += round.center[k] * round.center[k];
    }
    round.radius = std::sqrt(square);
    constexpr int kSteps = 20; // each step gains digits; 20 suffice if the noise is 0.1 of the radius
    for (int step = 0; step < kSteps; ++step) {
        const auto change = leastSquares<kUnknowns>(points, [&](const Row<Dimensions>& point) {
            Row<kUnknowns> row{};
            double distance = 0;
            for (std::size_t k = 0; k < Dimensions; ++k) distance += std::pow(point[k] - round.center[k], 2);
            distance = std::sqrt(distance);
            for (std::size_t k = 0; k < Dimensions && distance > 0; ++k)
                row[k] = (point[k] - round.center[k]) / distance;
            row[Dimensions] = 1;
            return std::pair(row, distance - round.radius);
        });
        if (!change) break; // the arc is so short that the algebraic fit is as good as any
        for (std::size_t k = 0; k < Dimensions; ++k) round.center[k] += (*change)[k];
        round.radius += (*change)[Dimensions];
    }
    return round;
}

} // namespace pointrt
