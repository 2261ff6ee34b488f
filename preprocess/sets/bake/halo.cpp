// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/sets/bake/halo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "preprocess/neighbors/neighbors.h"

namespace pointrt {

namespace {

/// With so many others that have too few neighbours as well, nearer than its rim, a point is of a surface and no stray:
/// along a border each has the one before and the one behind it.
constexpr std::size_t kTogether = 2;

/// Points counted in cubes a quarter of the halo wide: all in a cube and the 26 around it lie within 2 sqrt(3) / 4 =
/// 0.87 halos of any in it.
class CoarseCounts {
public:
    CoarseCounts(const std::vector<Vec3f>& positions, const Vec3d& low, double halo) : low_(low), per_edge_(4 / halo) {
        for (const Vec3f& position : positions) ++cubes_[keyOf(position)].own;
        for (auto& [key, cube] : cubes_) cube.around = sumAround(key);
    }

    std::uint32_t around(const Vec3f& position) const { return cubes_.at(keyOf(position)).around; }

private:
    struct Cube {
        std::uint32_t own = 0, around = 0;
    };

    /// 21 bits an axis, as a halo is more than a millionth of a tile, and none of them 0, so that neighbours do not run
    /// into one another.
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
    Vec3d low_;
    double per_edge_;
    std::unordered_map<std::uint64_t, Cube> cubes_;
};

double rimDistance(const Vec3f& position, const Vec3d& low, const Vec3d& high) {
    const Vec3d place = position.cast<double>();
    return std::min((place - low).minCoeff(), (high - place).minCoeff());
}

/// Of the points those with fewer than count others nearer than the rim.
std::vector<Vec3f> thoseThatLack(const std::vector<Vec3f>& positions, const std::vector<std::uint32_t>& asked,
                                 const Vec3d& low, const Vec3d& high, std::size_t count) {
    if (asked.empty()) return {};
    const surface::NearestSearch search(positions);
    std::vector<std::uint8_t> lacks(asked.size());
    tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t a) {
        const Vec3f& position = positions[asked[a]];
        const double rim = rimDistance(position, low, high);
        std::vector<std::uint32_t> found(count + 1); // with itself
        std::vector<float> squared(count + 1);
        lacks[a] = search.nearest(position, found, squared, static_cast<float>(rim * rim)) < found.size();
    });
    std::vector<Vec3f> lacking;
    for (std::size_t a = 0; a < asked.size(); ++a)
        if (lacks[a]) lacking.push_back(positions[asked[a]]);
    return lacking;
}

} // namespace

bool isHaloTooNarrow(const std::vector<Vec3f>& positions, const std::vector<std::uint8_t>& core, const Vec3d& low,
                     const Vec3d& high, double halo, std::size_t k) {
    const CoarseCounts counts(positions, low, halo);
    std::vector<std::uint32_t> doubtful;
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        if (core[i] && counts.around(positions[i]) <= k) doubtful.push_back(i);
    const std::vector<Vec3f> lacking = thoseThatLack(positions, doubtful, low, high, k);
    std::vector<std::uint32_t> all(lacking.size());
    std::iota(all.begin(), all.end(), 0u);
    return thoseThatLack(lacking, all, low, high, kTogether).size() < lacking.size();
}

} // namespace pointrt
