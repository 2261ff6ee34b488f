// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/principal_axes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pointrt {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// A rotation in the plane of axes p and q that makes m[p][q] zero (Jacobi's method; Golub and Van Loan, 8.5).
void rotate(Matrix& m, Matrix& vectors, std::size_t p, std::size_t q) {
    if (m[p][q] == 0) return;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1));
    const double c = 1 / std::hypot(t, 1), s = t * c;
    for (std::size_t k = 0; k < 3; ++k) {
        const double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double a = m[p][k], b = m[q][k], u = vectors[p][k], v = vectors[q][k];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
        vectors[p][k] = c * u - s * v;
        vectors[q][k] = s * u + c * v;
    }
}

/// The sum of products of coordinates, divided by the number of points.
Matrix covariance(std::span<const Vec3> points, Vec3 center) {
    Matrix m{};
    for (const Vec3& point : points) {
        const Vec3 d = point - center;
        const double at[] = {d.x, d.y, d.z};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) m[i][j] += at[i] * at[j] / static_cast<double>(points.size());
    }
    return m;
}

Vec3 centroid(std::span<const Vec3> points) {
    Vec3 sum; // of differences, since national coordinates have seven digits
    for (const Vec3& point : points) sum = sum + (point - points[0]);
    return points[0] + (1 / static_cast<double>(points.size())) * sum;
}

} // namespace

PrincipalAxes principalAxes(std::span<const Vec3> points) {
    constexpr int kSweeps = 12; // convergence is quadratic: 3 x 3 matrices are diagonal to the last bit after 6
    PrincipalAxes result;
    result.center = centroid(points);
    Matrix m = covariance(points, result.center), vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (const auto& [p, q] : {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u)}) rotate(m, vectors, p, q);
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return m[a][a] > m[b][b]; });
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& [x, y, z] = vectors[order[k]];
        result.axes[k] = normalize({x, y, z});
        result.deviation[k] = std::sqrt(std::max(0.0, m[order[k]][order[k]]));
    }
    return result;
}

} // namespace pointrt
