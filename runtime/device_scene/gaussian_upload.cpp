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

/// Row k of M: the axis over its half length in the ellipsoid. Gaussians that count nowhere are in no list.
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

/// The bytes of three coefficients of a Gaussian to a word each.
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

/// Parents come before their children.
std::uint32_t mostListed(const std::vector<gpu::GaussianNode>& nodes) {
    std::vector<std::uint32_t> listed(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        listed[k] += nodes[k].count;
        for (std::uint32_t slot = 0; nodes[k].children != 0 && slot < PRO_GROUP_SIZE; ++slot)
            listed[nodes[k].children + slot] = listed[k];
    }
    return *std::max_element(listed.begin(), listed.end());
}

/// The bounding box of the ellipsoids that are not empty; the unit cube if all are empty.
CubeBox boxAround(const std::vector<GaussianEllipsoid>& ellipsoids) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    CubeBox box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
    for (const GaussianEllipsoid& each : ellipsoids)
        for (std::size_t i = 0; i < 3; ++i) {
            double squared = 0;
            for (const auto& axis : each.half_axes) squared += double{axis[i]} * axis[i];
            if (squared == 0) continue;
            box.low[i] = std::min(box.low[i], each.center[i] - std::sqrt(squared));
            box.high[i] = std::max(box.high[i], each.center[i] + std::sqrt(squared));
        }
    return box.low[0] <= box.high[0] ? box : CubeBox{{0, 0, 0}, {1, 1, 1}};
}

/// Every ray tests what reaches out of the cube: if those are many, as of skies and of the tiles of a set, the cube is
/// enlarged, by powers of two. Floats leave 2^-24 of its edge to a mean, so not further than by 8.
constexpr std::size_t kMostOutside = 64;
constexpr double kMostEnlargement = 8;

double enlargementFor(const std::vector<GaussianEllipsoid>& ellipsoids) {
    std::array<std::size_t, 4> outside{}; // of the cube, of one twice as wide, and so on
    for (const GaussianEllipsoid& each : ellipsoids) {
        double farthest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            double squared = 0;
            for (const auto& axis : each.half_axes) squared += double{axis[i]} * axis[i];
            farthest = std::max(farthest, 2 * (std::abs(each.center[i] - 0.5) + std::sqrt(squared)));
        }
        for (std::size_t k = 0; k < outside.size(); ++k) outside[k] += farthest > std::exp2(k);
    }
    double enlargement = 1;
    for (std::size_t k = 0; outside[k] > kMostOutside && enlargement < kMostEnlargement; ++k) enlargement *= 2;
    return enlargement;
}

GaussianEllipsoid enlarged(GaussianEllipsoid ellipsoid, double enlargement) {
    for (double& each : ellipsoid.center) each = (each - 0.5) / enlargement + 0.5;
    for (auto& axis : ellipsoid.half_axes)
        for (float& each : axis) each /= static_cast<float>(enlargement);
    return ellipsoid;
}

} // namespace

GaussianBuffers decodeGaussians(const pro_gaussians& gaussians, const std::uint32_t* splats, std::uint32_t count) {
    constexpr std::size_t kEach = 1 << 14; // Gaussians of a task: some milliseconds
    const std::uint32_t coefficients = pro_harmonic_count(gaussians.degree);
    const std::size_t words = kTexelWords * HARMONIC_TEXELS(gaussians.degree);
    GaussianBuffers buffers;
    buffers.rows.resize(count);
    buffers.harmonics.resize(words * count);
    std::vector<GaussianEllipsoid> ellipsoids(count);
    forAll((count + kEach - 1) / kEach, [&](std::size_t task) {
        for (std::size_t k = task * kEach; k < std::min<std::size_t>(count, (task + 1) * kEach); ++k) {
            pro_gaussian gaussian;
            pro_gaussian_decode(&gaussians, splats + k * PRO_SPLAT_WORDS, gaussians.words + k * PRO_GAUSSIAN_WORDS,
                                &gaussian);
            ellipsoids[k] = ellipsoidOf(gaussian);
            buffers.rows[k].look = {gaussian.opacity, gaussian.color[0], gaussian.color[1], gaussian.color[2]};
            if (coefficients > 0)
                packHarmonics(gaussians.harmonics + 3 * coefficients * k, coefficients, &buffers.harmonics[words * k]);
        }
    });
    buffers.box = boxAround(ellipsoids);
    buffers.enlargement = enlargementFor(ellipsoids);
    for (std::size_t k = 0; k < count; ++k) {
        ellipsoids[k] = enlarged(ellipsoids[k], buffers.enlargement);
        setRows(ellipsoids[k], buffers.rows[k]);
    }
    GaussianTree tree = buildGaussianTree(ellipsoids, kTracedFineness);
    buffers.nodes = nodesOf(tree);
    buffers.most_listed = mostListed(buffers.nodes);
    buffers.lists = std::move(tree.lists);
    return buffers;
}

} // namespace pointrt
