// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/photon_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace pointrt {

namespace {

/// Smallest number of photons in a kernel where they are dense. The relative error of the light is about the inverse
/// root of this number, or less, since photons are quasi-random.
constexpr std::uint32_t kKernelPhotons = 48;
/// Photons sampled to choose the finest radius.
constexpr std::size_t kProbes = 64;
/// Approximate number of photons to search for neighbours in.
constexpr std::size_t kSearched = 1u << 16;
/// Largest radius of the finest kernel, in scene radii.
constexpr double kMaxRadius = 0.01;

double squaredDistance(const gpu::Photon& a, const gpu::Photon& b) {
    const double x = a.position.x - b.position.x, y = a.position.y - b.position.y, z = a.position.z - b.position.z;
    return x * x + y * y + z * z;
}

/// The 1/8 quantile of the distances of kProbes photons to their kKernelPhotons-th neighbour. If there are many
/// photons, searches only every n-th of them, for the neighbour of a rank n times lower; averaging over the probes
/// makes up for the lower precision.
double finestRadius(const std::vector<gpu::Photon>& photons) {
    const std::size_t thinning = std::clamp<std::size_t>(photons.size() / kSearched, 1, kKernelPhotons / 4);
    std::vector<gpu::Photon> searched;
    for (std::size_t i = 0; i < photons.size(); i += thinning) searched.push_back(photons[i]);
    const std::size_t step = std::max<std::size_t>(searched.size() / kProbes, 1);
    const std::size_t rank = std::min<std::size_t>(kKernelPhotons / thinning, searched.size() - 1);
    std::vector<double> distances(searched.size()), radii;
    for (std::size_t probe = 0; probe < searched.size(); probe += step) {
        std::transform(searched.begin(), searched.end(), distances.begin(),
                       [&](const gpu::Photon& each) { return squaredDistance(each, searched[probe]); });
        std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(rank), distances.end());
        radii.push_back(std::sqrt(distances[rank]));
    }
    const auto eighth = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 8);
    std::nth_element(radii.begin(), eighth, radii.end());
    return *eighth;
}

struct Vec3f {
    float x, y, z;
};

struct Cell {
    std::int32_t x, y, z;
};

/// Must agree with the shader.
Cell cellOf(Vec3f at, float cells) {
    const auto along = [&](float x) { return static_cast<std::int32_t>(std::floor(x * cells)); };
    return {along(at.x), along(at.y), along(at.z)};
}

Vec3f placeOf(const gpu::Photon& photon) { return {photon.position.x, photon.position.y, photon.position.z}; }

/// Must agree with shaders/shade/caustic.glsl.
std::uint32_t bucketOf(Cell cell, std::uint32_t level) {
    const auto u = [](std::int32_t i) { return static_cast<std::uint32_t>(i); };
    return (u(cell.x) * PHOTON_HASH_X ^ u(cell.y) * PHOTON_HASH_Y ^ u(cell.z) * PHOTON_HASH_Z ^
            level * PHOTON_HASH_LEVEL) %
           PHOTON_BUCKETS;
}

using Levels = std::span<const gpu::PhotonLevel, PHOTON_LEVELS>;

std::uint32_t levelOf(const gpu::Photon& photon) { return static_cast<std::uint32_t>(photon.flux.w); }

std::uint32_t ownBucket(const gpu::Photon& photon, Levels levels, std::uint32_t level) {
    return bucketOf(cellOf(placeOf(photon), levels[level].low.w), level);
}

/// Assigns each photon the finest level at which enough others share its cell.
void chooseLevels(std::vector<gpu::Photon>& photons, Levels levels) {
    // a disc covers pi / 4 of a cell
    constexpr std::uint32_t kCellPhotons = kKernelPhotons * 4 / 3;
    for (gpu::Photon& photon : photons) photon.flux.w = PHOTON_LEVELS - 1;
    for (std::uint32_t level = PHOTON_LEVELS - 1; level-- > 0;) {
        std::vector<std::uint32_t> counts(PHOTON_BUCKETS, 0);
        for (const gpu::Photon& photon : photons) ++counts[ownBucket(photon, levels, level)];
        for (gpu::Photon& photon : photons)
            if (counts[ownBucket(photon, levels, level)] >= kCellPhotons) photon.flux.w = static_cast<float>(level);
    }
}

/// The start of each bucket in an array of all entries, and the end of the last one. bucketsOf(i, visit) visits the
/// buckets of photon i.
template <typename BucketsOf>
std::vector<std::uint32_t> startsOf(std::size_t photons, const BucketsOf& bucketsOf) {
    std::vector<std::uint32_t> starts(PHOTON_BUCKETS + 1, 0);
    for (std::size_t i = 0; i < photons; ++i) bucketsOf(i, [&](std::uint32_t bucket) { ++starts[bucket + 1]; });
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    return starts;
}

std::vector<gpu::Photon> sortedByCell(const std::vector<gpu::Photon>& photons, Levels levels) {
    const auto own = [&](std::size_t i, const auto& visit) {
        visit(ownBucket(photons[i], levels, levelOf(photons[i])));
    };
    std::vector<std::uint32_t> next = startsOf(photons.size(), own);
    std::vector<gpu::Photon> sorted(photons.size());
    for (std::size_t i = 0; i < photons.size(); ++i)
        own(i, [&](std::uint32_t bucket) { sorted[next[bucket]++] = photons[i]; });
    return sorted;
}

/// Visits the buckets of the cells that the photon's disc overlaps, each once.
template <typename Visit>
void visitBuckets(const gpu::Photon& photon, Levels levels, const Visit& visit) {
    const std::uint32_t level = levelOf(photon), bits = std::bit_cast<std::uint32_t>(photon.position.w);
    const float cells = levels[level].low.w;
    const auto byte = [&](unsigned shift) {
        return static_cast<float>(static_cast<std::int8_t>(bits >> shift & 0xFF)) / 127.0f;
    };
    const Vec3f normal{byte(0), byte(8), byte(16)}, place = placeOf(photon),
                                                    in_cells{place.x * cells, place.y * cells, place.z * cells};
    // in cells: half the extent of a cell along the normal, plus that of the disc, with a margin for rounding
    const float reach = 0.5f * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) + 0.51f * PHOTON_REACH;
    const Cell low = cellOf({place.x - 0.5f / cells, place.y - 0.5f / cells, place.z - 0.5f / cells}, cells);
    std::array<std::uint32_t, 8> visited{};
    auto end = visited.begin();
    for (std::int32_t corner = 0; corner < 8; ++corner) {
        const Cell cell{low.x + (corner & 1), low.y + (corner >> 1 & 1), low.z + (corner >> 2)};
        const auto off = [](std::int32_t c, float at) { return static_cast<float>(c) + 0.5f - at; };
        const float height = normal.x * off(cell.x, in_cells.x) + normal.y * off(cell.y, in_cells.y) +
                             normal.z * off(cell.z, in_cells.z);
        const std::uint32_t bucket = bucketOf(cell, level);
        if (std::abs(height) > reach || std::find(visited.begin(), end, bucket) != end) continue;
        *end++ = bucket;
        visit(bucket);
    }
}

/// The words of PhotonMap::buckets.
std::vector<std::uint32_t> listByCell(const std::vector<gpu::Photon>& photons, Levels levels) {
    const auto buckets = [&](std::size_t i, const auto& visit) { visitBuckets(photons[i], levels, visit); };
    std::vector<std::uint32_t> words = startsOf(photons.size(), buckets);
    for (std::uint32_t& start : words) start += PHOTON_BUCKETS + 1;
    std::vector<std::uint32_t> next = words;
    words.resize(words.back());
    for (std::uint32_t i = 0; i < photons.size(); ++i)
        buckets(i, [&](std::uint32_t bucket) { words[next[bucket]++] = i; });
    return words;
}

/// Initializes the levels of a map without photons.
void setRadii(gpu::CausticFrame& frame, double finest) {
    constexpr float kNowhere = std::numeric_limits<float>::max();
    for (gpu::PhotonLevel& level : frame.levels) {
        level.low = {kNowhere, kNowhere, kNowhere, static_cast<float>(0.5 / finest)};
        level.high = {-kNowhere, -kNowhere, -kNowhere, static_cast<float>(finest)};
        finest *= PHOTON_LEVEL_RATIO;
    }
}

void growBoxes(gpu::CausticFrame& frame, const std::vector<gpu::Photon>& photons) {
    for (const gpu::Photon& photon : photons) {
        gpu::PhotonLevel& level = frame.levels[levelOf(photon)];
        const gpu::vec4& at = photon.position;
        const float r = level.high.w;
        level.low = {std::min(level.low.x, at.x - r), std::min(level.low.y, at.y - r), std::min(level.low.z, at.z - r),
                     level.low.w};
        level.high = {std::max(level.high.x, at.x + r), std::max(level.high.y, at.y + r),
                      std::max(level.high.z, at.z + r), r};
    }
}

} // namespace

PhotonMap sortPhotons(std::vector<gpu::Photon> photons, double scene_radius, PhotonDiscs discs) {
    PhotonMap map;
    map.buckets.assign(PHOTON_BUCKETS + 1, PHOTON_BUCKETS + 1);
    setRadii(map.frame, 1);
    if (photons.empty()) return map;
    // at least the resolution of floats at that size
    const double least = 1e-5 * scene_radius;
    map.finest = discs.finest > 0 ? discs.finest : std::clamp(finestRadius(photons), least, kMaxRadius * scene_radius);
    map.frame.count = {static_cast<std::uint32_t>(photons.size()), 0, 0, 0};
    const Levels levels(map.frame.levels);
    // uses cells that do not shrink: narrower cells would measure the density less and less precisely
    setRadii(map.frame, map.finest);
    chooseLevels(photons, levels);
    setRadii(map.frame, std::max(map.finest * discs.shrink, least));
    map.photons = sortedByCell(photons, levels);
    map.buckets = listByCell(map.photons, levels);
    growBoxes(map.frame, map.photons);
    return map;
}

} // namespace pointrt
