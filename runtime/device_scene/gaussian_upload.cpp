// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/gaussian_upload.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "format/base/parallel.h"
#include "format/index/gaussian_tree.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kTexelWords = 4;

/// Row k of M (gaussian_layout.h): the unit vector along axis k, divided by the axis's half length. Gaussians that are
/// too faint to count are in no list.
gpu::vec4 rowOf(const std::array<float, 3>& half_axis, double mean) {
    const float squared = half_axis[0] * half_axis[0] + half_axis[1] * half_axis[1] + half_axis[2] * half_axis[2];
    const float inverse = squared > 0 ? 1 / squared : 0.0f;
    return {half_axis[0] * inverse, half_axis[1] * inverse, half_axis[2] * inverse, static_cast<float>(mean)};
}

void setRows(const GaussianEllipsoid& ellipsoid, gpu::GaussianRows& rows) {
    rows.row_x = rowOf(ellipsoid.half_axes[0], ellipsoid.center[0]);
    rows.row_y = rowOf(ellipsoid.half_axes[1], ellipsoid.center[1]);
    rows.row_z = rowOf(ellipsoid.half_axes[2], ellipsoid.center[2]);
}

/// Packs three coefficients of a Gaussian, one byte each, into one word.
void packHarmonics(const std::int8_t* codes, std::uint32_t count, std::uint32_t* words) {
    const auto byte = [](std::int8_t code) { return std::uint32_t{static_cast<std::uint8_t>(code)}; };
    for (std::uint32_t k = 0; k < count; ++k)
        words[k] = byte(codes[3 * k]) | byte(codes[3 * k + 1]) << 8 | byte(codes[3 * k + 2]) << 16;
}

std::vector<gpu::GaussianNode> nodesOf(const GaussianTree& tree) {
    std::vector<gpu::GaussianNode> nodes(tree.nodeCount());
    const auto firstOf = [&](std::uint32_t k) {
        return k < tree.nodeCount() ? tree.nodes[2 * k + 1] : static_cast<std::uint32_t>(tree.lists.size());
    };
    for (std::uint32_t k = 0; k < tree.nodeCount(); ++k) {
        const std::uint32_t children = PRO_GROUP_SIZE * tree.nodes[2 * k];
        nodes[k].children = children;
        nodes[k].first = firstOf(k);
        nodes[k].count = firstOf(k + 1) - firstOf(k);
        if (children == 0) continue;
        for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) nodes[children + slot].parent = k;
    }
    nodes[0].parent = NO_INDEX;
    return nodes;
}

/// Half extents of the ellipsoid's bounding box; 0 if it is empty.
std::array<double, 3> reachOf(const GaussianEllipsoid& ellipsoid) {
    std::array<double, 3> reach{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (const auto& axis : ellipsoid.half_axes) reach[i] += double{axis[i]} * axis[i];
        reach[i] = std::sqrt(reach[i]);
    }
    return reach;
}

/// The bounding box of the ellipsoids that are not empty; the unit cube if all are empty.
CubeBox boxAround(const std::vector<GaussianEllipsoid>& ellipsoids) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    CubeBox box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
    for (const GaussianEllipsoid& each : ellipsoids) {
        const std::array<double, 3> reach = reachOf(each);
        for (std::size_t i = 0; reach[0] > 0 && i < 3; ++i) {
            box.low[i] = std::min(box.low[i], each.center[i] - reach[i]);
            box.high[i] = std::max(box.high[i], each.center[i] + reach[i]);
        }
    }
    return box.low[0] <= box.high[0] ? box : CubeBox{{0, 0, 0}, {1, 1, 1}};
}

/// For each ellipsoid that is not empty: half the edge of the smallest cube centred on point that contains the
/// ellipsoid.
std::vector<double> halfEdgesAround(const std::array<double, 3>& point,
                                    const std::vector<GaussianEllipsoid>& ellipsoids) {
    std::vector<double> halves;
    halves.reserve(ellipsoids.size());
    for (const GaussianEllipsoid& each : ellipsoids) {
        const std::array<double, 3> reach = reachOf(each);
        if (!(reach[0] > 0)) continue;
        double half = 0;
        for (std::size_t i = 0; i < 3; ++i) half = std::max(half, std::abs(each.center[i] - point[i]) + reach[i]);
        halves.push_back(half);
    }
    return halves;
}

/// Every ray tests the Gaussians that extend beyond the cube. If there are many, as in skies and in the tiles of a set,
/// the cube is enlarged by a power of two, at most 8: floats resolve positions to 2^-24 of its edge.
constexpr std::ptrdiff_t kMostOutside = 64;
constexpr double kMostEnlargement = 8;

TracedCube enlargedCube(const std::vector<GaussianEllipsoid>& ellipsoids) {
    const std::vector<double> halves = halfEdgesAround({0.5, 0.5, 0.5}, ellipsoids);
    const auto outside = [&](double edge) {
        return std::count_if(halves.begin(), halves.end(), [&](double half) { return 2 * half > edge; });
    };
    double edge = 1;
    while (edge < kMostEnlargement && outside(edge) > kMostOutside) edge *= 2;
    const double low = (1 - edge) / 2;
    return {{low, low, low}, edge};
}

/// A few giants or distant floaters can make the cube so large that floats cannot resolve the other Gaussians: 2^-24 of
/// a cube 1,000 times as wide as the scene is half the deviation of a thin Gaussian. In that case the cube is chosen
/// around the others, provided that its smaller size gains floats at least four bits.
constexpr std::size_t kMostApart = 256;
constexpr double kLeastGain = 16, kCoreMargin = 1 + 1.0 / 1024;
/// Means in files have steps of 2^-27. In a cube of this edge, floats are finer than that, and positions outside it
/// stay far below the largest float.
constexpr double kLeastCore = 1.0 / 4096;

/// The cube around all but kMostApart Gaussians; infinite if there are no others.
TracedCube coreCube(const std::vector<GaussianEllipsoid>& ellipsoids) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    if (ellipsoids.size() <= kMostApart) return {{}, kFar};
    std::array<double, 3> middle{};
    std::vector<double> centers(ellipsoids.size());
    for (std::size_t i = 0; i < 3; ++i) {
        std::transform(ellipsoids.begin(), ellipsoids.end(), centers.begin(),
                       [&](const GaussianEllipsoid& each) { return each.center[i]; });
        const auto median = centers.begin() + static_cast<std::ptrdiff_t>(centers.size() / 2);
        std::nth_element(centers.begin(), median, centers.end());
        middle[i] = *median;
    }
    std::vector<double> halves = halfEdgesAround(middle, ellipsoids);
    if (halves.size() <= kMostApart) return {{}, kFar};
    const auto last = halves.end() - static_cast<std::ptrdiff_t>(kMostApart) - 1;
    std::nth_element(halves.begin(), last, halves.end());
    const double half = std::max(*last * kCoreMargin, kLeastCore / 2);
    return {{middle[0] - half, middle[1] - half, middle[2] - half}, 2 * half};
}

TracedCube cubeFor(const std::vector<GaussianEllipsoid>& ellipsoids) {
    const TracedCube around = enlargedCube(ellipsoids), core = coreCube(ellipsoids);
    return kLeastGain * core.edge <= around.edge ? core : around;
}

GaussianEllipsoid inCube(GaussianEllipsoid ellipsoid, const TracedCube& cube) {
    for (std::size_t i = 0; i < 3; ++i) ellipsoid.center[i] = (ellipsoid.center[i] - cube.low[i]) / cube.edge;
    for (auto& axis : ellipsoid.half_axes)
        for (float& each : axis) each /= static_cast<float>(cube.edge);
    return ellipsoid;
}

} // namespace

GaussianBuffers decodeGaussians(const pro_gaussians& gaussians, const std::uint32_t* splats, std::uint32_t count) {
    constexpr std::size_t kEach = 1 << 14; // Gaussians per task, which takes some milliseconds
    const std::uint32_t coefficients = pro_harmonic_count(gaussians.degree);
    const std::size_t words = kTexelWords * HARMONIC_TEXELS(gaussians.degree);
    GaussianBuffers buffers;
    buffers.rows.resize(count);
    buffers.harmonics.resize(words * count);
    std::vector<GaussianEllipsoid> ellipsoids(count);
    forAll((count + kEach - 1) / kEach, [&](std::size_t task) {
        for (std::size_t k = task * kEach; k < std::min<std::size_t>(count, (task + 1) * kEach); ++k) {
            pro_gaussian gaussian;
            pro_gaussian_at(&gaussians, splats, static_cast<std::uint32_t>(k), &gaussian);
            ellipsoids[k] = ellipsoidOf(gaussian);
            buffers.rows[k].look = {gaussian.opacity, gaussian.color[0], gaussian.color[1], gaussian.color[2]};
            if (coefficients > 0)
                packHarmonics(gaussians.harmonics + 3 * coefficients * k, coefficients, &buffers.harmonics[words * k]);
        }
    });
    buffers.box = boxAround(ellipsoids);
    buffers.cube = cubeFor(ellipsoids);
    for (std::size_t k = 0; k < count; ++k) {
        ellipsoids[k] = inCube(ellipsoids[k], buffers.cube);
        setRows(ellipsoids[k], buffers.rows[k]);
    }
    const CubeBox box = boxAround(ellipsoids);
    for (std::size_t i = 0; i < 3; ++i) buffers.reaches_out |= box.low[i] < 0 || box.high[i] >= 1;
    GaussianTree tree = buildGaussianTree(ellipsoids, kTracedFineness);
    buffers.nodes = nodesOf(tree);
    buffers.lists = std::move(tree.lists);
    return buffers;
}

} // namespace pointrt
