// SPDX-License-Identifier: Apache-2.0
#include "runtime/photon_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace pointrt {

namespace {

/// Photons in the typical kernel: the light's relative error is about the inverse root of this, less by the evenness of
/// quasi-random photons.
constexpr std::uint32_t kKernelPhotons = 48;
/// Photons that the typical distance is taken from.
constexpr std::size_t kProbes = 64;
/// The finest kernel's radius in scene radii, at most.
constexpr double kMostRadius = 0.01;

double squaredDistance(const gpu::Photon& a, const gpu::Photon& b) {
    const double x = a.position.x - b.position.x, y = a.position.y - b.position.y, z = a.position.z - b.position.z;
    return x * x + y * y + z * z;
}

/// Of the distances from every n-th photon to its kKernelPhotons-th neighbour the median.
double typicalRadius(const std::vector<gpu::Photon>& photons) {
    const std::size_t step = std::max<std::size_t>(photons.size() / kProbes, 1);
    const std::size_t rank = std::min<std::size_t>(kKernelPhotons, photons.size() - 1);
    std::vector<double> distances(photons.size()), radii;
    for (std::size_t probe = 0; probe < photons.size(); probe += step) {
        std::transform(photons.begin(), photons.end(), distances.begin(),
                       [&](const gpu::Photon& each) { return squaredDistance(each, photons[probe]); });
        std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(rank), distances.end());
        radii.push_back(std::sqrt(distances[rank]));
    }
    std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
    return radii[radii.size() / 2];
}

struct Cell {
    std::uint32_t x, y, z;
};

Cell cellOf(const gpu::Photon& photon, float cells) {
    const auto along = [&](float at) {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(at * cells)));
    };
    return {along(photon.position.x), along(photon.position.y), along(photon.position.z)};
}

/// As in shaders/caustic.glsl.
std::uint32_t bucketOf(const gpu::Photon& photon, float cells, std::uint32_t level) {
    const Cell cell = cellOf(photon, cells);
    return (cell.x * PHOTON_HASH_X ^ cell.y * PHOTON_HASH_Y ^ cell.z * PHOTON_HASH_Z ^ level * PHOTON_HASH_LEVEL) %
           PHOTON_BUCKETS;
}

/// The levels' cells in a stage unit, computed as the shader does.
std::array<float, PHOTON_LEVELS> levelCells(float finest) {
    std::array<float, PHOTON_LEVELS> cells{};
    for (float& each : cells) {
        each = finest;
        finest /= PHOTON_LEVEL_RATIO;
    }
    return cells;
}

/// Each photon to the finest level where enough others share its cell.
void chooseLevels(std::vector<gpu::Photon>& photons, const std::array<float, PHOTON_LEVELS>& cells) {
    // a disc takes pi / 4 of a cell
    constexpr std::uint32_t kCellPhotons = kKernelPhotons * 4 / 3;
    for (gpu::Photon& photon : photons) photon.flux.w = PHOTON_LEVELS - 1;
    for (std::uint32_t level = PHOTON_LEVELS - 1; level-- > 0;) {
        std::vector<std::uint32_t> counts(PHOTON_BUCKETS, 0);
        for (const gpu::Photon& photon : photons) ++counts[bucketOf(photon, cells[level], level)];
        for (gpu::Photon& photon : photons)
            if (counts[bucketOf(photon, cells[level], level)] >= kCellPhotons)
                photon.flux.w = static_cast<float>(level);
    }
}

} // namespace

PhotonMap sortPhotons(std::vector<gpu::Photon> photons, double scene_radius) {
    PhotonMap map;
    map.buckets.assign(PHOTON_BUCKETS + 1, 0);
    if (photons.empty()) return map;
    // no narrower than what floats of that size tell apart
    const double radius = std::clamp(typicalRadius(photons), 1e-5 * scene_radius, kMostRadius * scene_radius);
    map.frame.kernel = {static_cast<float>(radius), static_cast<float>(0.5 / radius),
                        static_cast<float>(3 / (std::numbers::pi * radius * radius)), 0};
    map.frame.count = {static_cast<std::uint32_t>(photons.size()), 0, 0, 0};
    const std::array<float, PHOTON_LEVELS> cells = levelCells(map.frame.kernel.y);
    chooseLevels(photons, cells);

    const auto bucket = [&](const gpu::Photon& photon) {
        const auto level = static_cast<std::uint32_t>(photon.flux.w);
        return bucketOf(photon, cells[level], level);
    };
    for (const gpu::Photon& photon : photons) ++map.buckets[bucket(photon) + 1];
    std::partial_sum(map.buckets.begin(), map.buckets.end(), map.buckets.begin());
    std::vector<std::uint32_t> next = map.buckets;
    map.photons.resize(photons.size());
    for (const gpu::Photon& photon : photons) map.photons[next[bucket(photon)]++] = photon;
    return map;
}

} // namespace pointrt
