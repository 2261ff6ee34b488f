// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/halo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "preprocess/surface/neighbors.h"
#include "preprocess/tiles/buckets.h"

namespace pointrt {

namespace {

/// Required distance of a point from the rim, in distances of its k-th neighbour. Neighbours of neighbours matter, so 1
/// is too little: of 24,120 points in tiles of 4,000, one corner a hundred times as dense as the rest, 3 got another
/// normal or radius than in the whole cloud with 1, and none with 2 (SetTest.TilesOfFewPointsGetWiderHalos).
constexpr double kTimesAsNear = 2;

/// A point with this many others nearer than its rim that also lack neighbours is on a surface and not a stray: along a
/// border each has one on either side.
constexpr std::size_t kTogether = 2;

/// Counts points in cubes an eighth of the halo wide: all points in a cube and the 26 around it lie within 2 sqrt(3) /
/// 8 = 0.43 halos of any point in it, less than half the distance of the rim from a point of the core.
class CoarseCounts {
public:
    CoarseCounts(const std::vector<Vec3f>& positions, double halo) : per_edge_(8 / halo) {
        for (const Vec3f& position : positions) low_ = low_.cwiseMin(position.cast<double>());
        for (const Vec3f& position : positions) ++cubes_[keyOf(position)].own;
        for (auto& [key, cube] : cubes_) cube.around = sumAround(key);
    }

    std::uint32_t around(const Vec3f& position) const { return cubes_.at(keyOf(position)).around; }

private:
    struct Cube {
        std::uint32_t own = 0, around = 0;
    };

    /// 21 bits per axis, since a halo is more than a millionth of a tile; never 0, so that neighbours of different rows
    /// have different keys.
    std::uint64_t keyOf(const Vec3f& position) const {
        std::uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis)
            key = key << kBits | static_cast<std::uint64_t>((position[axis] - low_[axis]) * per_edge_ + 2);
        return key;
    }

    std::uint32_t sumAround(std::uint64_t key) const {
        std::uint32_t sum = 0;
        for (std::uint64_t x = 0; x < 3; ++x)
            for (std::uint64_t y = 0; y < 3; ++y)
                for (std::uint64_t z = 0; z < 3; ++z) {
                    const std::uint64_t lowest = key - (1ull << 2 * kBits) - (1ull << kBits) - 1;
                    const auto found = cubes_.find(lowest + (x << 2 * kBits) + (y << kBits) + z);
                    if (found != cubes_.end()) sum += found->second.own;
                }
        return sum;
    }

    static constexpr int kBits = 21;
    Vec3d low_ = Vec3d::Constant(std::numeric_limits<double>::infinity());
    double per_edge_;
    std::unordered_map<std::uint64_t, Cube> cubes_;
};

double rimDistance(const Vec3f& position, const Halo& halo) {
    const Vec3d place = position.cast<double>();
    return std::min((place - halo.low).minCoeff(), (halo.high - place).minCoeff());
}

/// Selects the points with fewer than count others within a share of the distance to the rim.
std::vector<Vec3f> pointsLackingNeighbors(const std::vector<Vec3f>& positions,
                                          const std::vector<std::uint32_t>& candidates, const Halo& halo, double share,
                                          std::size_t count) {
    if (candidates.empty()) return {};
    const surface::NearestSearch search(positions);
    std::vector<std::uint8_t> lacks(candidates.size());
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t a) {
        const Vec3f& position = positions[candidates[a]];
        const double radius = share * rimDistance(position, halo);
        std::vector<std::uint32_t> found(count + 1); // including itself
        std::vector<float> squared(count + 1);
        lacks[a] = search.nearest(position, found, squared, static_cast<float>(radius * radius)) < found.size();
    });
    std::vector<Vec3f> lacking;
    for (std::size_t a = 0; a < candidates.size(); ++a)
        if (lacks[a]) lacking.push_back(positions[candidates[a]]);
    return lacking;
}

} // namespace

Halo haloOf(const SetPlan& plan, const PlanTile& tile, double width) {
    const PlanBox core = coreOf(plan, tile), box = boxAround(plan, tile, width);
    Halo halo{width, box.min() - core.min(), box.max() - core.min()};
    for (int axis = 0; axis < 3; ++axis) {
        constexpr double kNever = std::numeric_limits<double>::infinity();
        if (plan.bounds.min()[axis] >= box.min()[axis]) halo.low[axis] = -kNever;
        if (plan.bounds.max()[axis] <= box.max()[axis]) halo.high[axis] = kNever;
    }
    return halo;
}

std::size_t countLacking(const std::vector<Vec3f>& positions, const std::vector<std::uint8_t>& core, const Halo& halo,
                         std::size_t k) {
    if (!halo.leavesPointsOut()) return 0;
    const CoarseCounts counts(positions, halo.width);
    std::vector<std::uint32_t> doubtful;
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (core[i] && counts.around(positions[i]) <= k) doubtful.push_back(i);
    const std::vector<Vec3f> lacking = pointsLackingNeighbors(positions, doubtful, halo, 1 / kTimesAsNear, k);
    std::vector<std::uint32_t> all(lacking.size());
    std::iota(all.begin(), all.end(), 0u);
    return lacking.size() - pointsLackingNeighbors(lacking, all, halo, 1, kTogether).size();
}

} // namespace pointrt
