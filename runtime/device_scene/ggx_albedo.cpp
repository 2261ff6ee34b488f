// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/ggx_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaders/shared/ggx_table.h"

namespace pointrt {
namespace {

// Quadrature nodes: table entries are within 0.0025 of converged ones.
constexpr int kTilts = 10;
constexpr int kAzimuths = 10;
// How strongly azimuths cluster at the side of the view, where the horizon changes fast at grazing angles. azimuth = x
// + kCrowding / 2 * sin(2 x) keeps the midpoint rule's accuracy for periodic functions.
constexpr double kCrowding = 0.95;

struct Node {
    double position, weight;
};

/// Gauss-Legendre nodes on [0, 1], by Newton's method on the Legendre polynomial.
std::array<Node, kTilts> gaussNodes() {
    std::array<Node, kTilts> nodes;
    for (int i = 0; i < kTilts; i++) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (kTilts + 0.5)), slope = 1;
        for (int step = 0; step < 8; step++) {
            double before = 1, value = x;
            for (int n = 2; n <= kTilts; n++) {
                const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
                before = value;
                value = next;
            }
            slope = kTilts * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        nodes[static_cast<std::size_t>(i)] = {0.5 * (1 + x), 1 / ((1 - x * x) * slope * slope)};
    }
    return nodes;
}

/// Azimuths around the stretched view direction: cosines and weights.
std::array<Node, kAzimuths> azimuthNodes() {
    std::array<Node, kAzimuths> nodes;
    for (int i = 0; i < kAzimuths; i++) {
        const double x = std::numbers::pi * (i + 0.5) / kAzimuths;
        nodes[static_cast<std::size_t>(i)] = {std::cos(x + kCrowding / 2 * std::sin(2 * x)),
                                              (1 + kCrowding * std::cos(2 * x)) / kAzimuths};
    }
    return nodes;
}

/// Smith's lambda for GGX: the ratio of hidden to visible facets, seen from a direction with this cosine.
double smithLambda(double cosine, double alpha2) {
    return 0.5 * (std::sqrt(1 + alpha2 * (1 - cosine * cosine) / (cosine * cosine)) - 1);
}

/// The view in the stretched configuration, in which GGX's normals are those of a hemisphere, seen from `axis`.
struct StretchedView {
    double cosine, alpha2;
    double stretch; // length of axis before normalisation
    double axis_tangent, axis_normal;
    double hidden; // lambda of the view
};

StretchedView stretchView(double cosine, double alpha) {
    const double alpha2 = alpha * alpha, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double stretch = std::sqrt(alpha2 * sine * sine + cosine * cosine);
    return {cosine, alpha2, stretch, alpha * sine / stretch, cosine / stretch, smithLambda(cosine, alpha2)};
}

/// For normals in a plane through the axis: the angle from the axis beyond which they reflect light below the horizon.
/// The condition is quadratic in the tangent of that angle, with one positive root.
/// @param lean slope of the normals' height along the plane
double horizonTilt(const StretchedView& view, double lean) {
    const double rest = 1 - view.alpha2;
    const double a = view.cosine * (view.alpha2 + rest * lean * lean);
    const double b = view.cosine * rest * view.axis_normal * lean - view.stretch * lean;
    const double c =
        view.cosine * (view.alpha2 + rest * view.axis_normal * view.axis_normal) - 2 * view.stretch * view.axis_normal;
    const double root = std::sqrt(b * b - a * c);
    return std::atan(b > 0 ? -c / (b + root) : (root - b) / a);
}

} // namespace

GgxAlbedo ggxAlbedoAt(double cosine, double roughness) {
    static const auto tilts = gaussNodes();
    static const auto azimuths = azimuthNodes();
    const StretchedView view = stretchView(cosine, roughness * roughness);
    double given = 0, grazing = 0;
    for (const Node& azimuth : azimuths) {
        const double lean = view.axis_tangent * azimuth.position, horizon = horizonTilt(view, lean);
        for (const Node& node : tilts) {
            const double tilt = node.position * horizon, c = std::cos(tilt), s = std::sin(tilt);
            const double normal_z = view.axis_normal * c + lean * s;
            const double length2 = view.alpha2 + (1 - view.alpha2) * normal_z * normal_z;
            const double out = std::clamp(2 * view.stretch * c * normal_z / length2 - cosine, 1e-12, 1.0);
            const double facing = view.stretch * c / std::sqrt(length2), miss = std::max(0.0, 1 - facing);
            // reflected directions are at twice the tilt; the cap has 2 pi (1 + axis_normal)
            const double area = 4 * s * c * node.weight * horizon * azimuth.weight / (1 + view.axis_normal);
            const double seen = area * (1 + view.hidden) / (1 + view.hidden + smithLambda(out, view.alpha2));
            given += seen;
            grazing += seen * miss * miss * miss * miss * miss;
        }
    }
    return {static_cast<float>(std::clamp(1 - given, 0.0, 1.0)), static_cast<float>(grazing)};
}

namespace {

/// The cosine-weighted mean over the hemisphere of the piecewise linear function through the values at x = 0, 1/n, ...,
/// 1, with cosine x^2: the integral of value * 4 x^3 dx.
template <typename ValueAt>
float cosineMean(ValueAt valueAt) {
    double mean = 0;
    const double step = 1.0 / (GGX_TABLE_SIDE - 1);
    for (int column = 0; column + 1 < GGX_TABLE_SIDE; column++) {
        const double lo = column * step, hi = lo + step;
        const double first = std::pow(hi, 4) - std::pow(lo, 4), second = 0.8 * (std::pow(hi, 5) - std::pow(lo, 5));
        const double slope = (valueAt(column + 1) - valueAt(column)) / step;
        mean += (valueAt(column) - slope * lo) * first + slope * second;
    }
    return static_cast<float>(mean);
}

// in place of cosine 0, where the quadrature's terms are undefined
constexpr double kMinCosine = 1e-6;

} // namespace

std::vector<GgxAlbedo> ggxAlbedoTable() {
    std::vector<GgxAlbedo> table(GGX_TABLE_ENTRIES);
    for (int row = 0; row < GGX_TABLE_SIDE; row++) {
        const double y = static_cast<double>(row) / (GGX_TABLE_SIDE - 1);
        const double roughness = GGX_MIN_ROUGHNESS + (1 - GGX_MIN_ROUGHNESS) * y;
        GgxAlbedo* const entries = &table[static_cast<std::size_t>(row) * GGX_TABLE_SIDE];
        for (int column = 0; column < GGX_TABLE_SIDE; column++) {
            const double x = static_cast<double>(column) / (GGX_TABLE_SIDE - 1);
            entries[column] = ggxAlbedoAt(std::max(x * x, kMinCosine), roughness);
        }
        table[static_cast<std::size_t>(GGX_TABLE_SIDE * GGX_TABLE_SIDE + row)] = {
            cosineMean([&](int column) { return entries[column].lost; }),
            cosineMean([&](int column) { return entries[column].grazing; })};
    }
    return table;
}

} // namespace pointrt
