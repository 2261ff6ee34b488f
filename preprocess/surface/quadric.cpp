// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/quadric.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace pointrt::surface {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Sums of u^i v^j up to order 4, of h times those up to order 2, and of h^2.
struct QuadricMoments {
    std::array<double, 15> powers{};
    std::array<double, 6> heights{};
    double height_square = 0;
};

/// Index of u^i v^j in QuadricMoments::powers: by order, then by the power of v.
constexpr std::size_t powerAt(int i, int j) {
    const int order = i + j;
    return std::size_t(order * (order + 1) / 2 + j);
}

constexpr std::array<std::array<int, 2>, 6> kTerms{{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};

Matrix6 matrixOf(const QuadricMoments& sums) {
    Matrix6 matrix;
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b)
            matrix(a, b) = sums.powers[powerAt(kTerms[std::size_t(a)][0] + kTerms[std::size_t(b)][0],
                                               kTerms[std::size_t(a)][1] + kTerms[std::size_t(b)][1])];
    return matrix;
}

/// Solves the normal equations; nullopt if a pivot shows that they are rank-deficient.
std::optional<Vector6> solve(const QuadricMoments& sums) {
    const Eigen::LDLT<Matrix6> factors(matrixOf(sums));
    const Vector6 pivots = factors.vectorD();
    constexpr double kSingular = 1e-7; // a smaller pivot, as a share of the largest, is rounding (1e-12), not shape
    if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return std::nullopt;
    return factors.solve(Eigen::Map<const Vector6>(sums.heights.data()));
}

void add(QuadricMoments& sums, double u, double v, double h) {
    const double u2 = u * u, uv = u * v, v2 = v * v;
    const std::array<double, 15> powers{1,      u,      v,       u2,      uv,      v2,      u2 * u, u2 * v,
                                        u * v2, v2 * v, u2 * u2, u2 * uv, u2 * v2, uv * v2, v2 * v2};
    for (std::size_t i = 0; i < 15; ++i) sums.powers[i] += powers[i];
    for (std::size_t i = 0; i < 6; ++i) sums.heights[i] += powers[i] * h;
    sums.height_square += h * h;
}

} // namespace

std::optional<QuadricFit> fitQuadric(const Neighborhood& around, const TangentFrame& frame, const AlgebraicSphere& from,
                                     float scale) {
    std::array<Lanes, 15> powers;
    std::array<Lanes, 6> heights;
    powers.fill(Lanes::Zero());
    heights.fill(Lanes::Zero());
    Lanes height_square = Lanes::Zero();
    const float inverse = 1 / (scale * scale);
    for (std::size_t group = 0; group < around.laneGroups(); ++group) {
        const auto of = [&](const std::vector<float>& values) { return Neighborhood::lanes(values, group); };
        const Lanes x = of(around.x), y = of(around.y), z = of(around.z);
        const auto along = [&](const Vec3f& axis) -> Lanes { return axis.x() * x + axis.y() * y + axis.z() * z; };
        const Lanes w = robustWeights(around, group, from, inverse);
        const Lanes u = along(frame.u), v = along(frame.v), h = along(frame.normal);
        const Lanes u2 = u * u, uv = u * v, v2 = v * v, wu2 = w * u2, wuv = w * uv, wv2 = w * v2;
        const std::array<Lanes, 15> terms{w,       w * u,   w * v,    wu2,      wuv,      wv2,      wu2 * u, wu2 * v,
                                          wv2 * u, wv2 * v, wu2 * u2, wu2 * uv, wu2 * v2, wuv * v2, wv2 * v2};
        for (std::size_t i = 0; i < 15; ++i) powers[i] += terms[i];
        for (std::size_t i = 0; i < 6; ++i) heights[i] += terms[i] * h;
        height_square += terms[0] * h * h;
    }
    QuadricMoments sums;
    for (std::size_t i = 0; i < 15; ++i) sums.powers[i] = double(powers[i].sum());
    for (std::size_t i = 0; i < 6; ++i) sums.heights[i] = double(heights[i].sum());
    const std::optional<Vector6> terms = solve(sums);
    if (!terms) return std::nullopt;
    QuadricFit fit;
    for (int i = 0; i < 6; ++i) fit.terms[std::size_t(i)] = float((*terms)[i]);
    const double explained = terms->dot(Eigen::Map<const Vector6>(sums.heights.data()));
    fit.variance = float(std::max(0.0, double(height_square.sum()) - explained) / sums.powers[0]);
    return fit;
}

Vec3f normalOf(const QuadricTerms& terms, const TangentFrame& frame) {
    return (frame.normal - terms[1] * frame.u - terms[2] * frame.v).normalized();
}

double residualVariance(const PointSet& points, std::span<const std::uint32_t> neighbors, std::size_t point) {
    constexpr std::size_t kTermCount = 6;
    if (neighbors.size() + 1 <= kTermCount + 1) return 0;
    const TangentFrame frame(points.normals[point]);
    const Vec3f& from = points.positions[point];
    const double reach = double(distanceBetween(from, points.positions[neighbors.back()]));
    if (!(reach > 0)) return 0;
    QuadricMoments sums;
    add(sums, 0, 0, 0);
    for (const std::uint32_t neighbor : neighbors) {
        const Vec3d offset = (points.positions[neighbor] - from).cast<double>() / reach;
        add(sums, offset.dot(frame.u.cast<double>()), offset.dot(frame.v.cast<double>()),
            offset.dot(frame.normal.cast<double>()));
    }
    const std::optional<Vector6> terms = solve(sums);
    if (!terms) return 0;
    const double explained = terms->dot(Eigen::Map<const Vector6>(sums.heights.data()));
    const double residual = std::max(0.0, sums.height_square - explained);
    return residual / double(neighbors.size() + 1 - kTermCount) * reach * reach;
}

} // namespace pointrt::surface
