// SPDX-License-Identifier: GPL-3.0-or-later
// All that lies within reach of many points at once.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Numbers that are worked on side by side: two vector registers of any x86-64.
using Lanes = Eigen::Array<float, 8, 1>;
constexpr std::size_t kLaneCount = 8;

/// The neighbours of one point, seen from it with its reach as the unit of length. Rounded up to whole lanes, of which
/// those behind count weigh nothing.
struct Surroundings {
    std::size_t count = 0;
    std::vector<float> x, y, z, nx, ny, nz;
    /// (1 - d^2)^4 of the distance d: 0 with all its slopes at the reach (Guennebaud and Gross 2007).
    std::vector<float> weight;
    std::vector<std::uint32_t> indices; ///< [count]

    std::size_t laneGroups() const { return (count + kLaneCount - 1) / kLaneCount; }
    static Lanes lanes(const std::vector<float>& values, std::size_t group) {
        return Eigen::Map<const Lanes>(values.data() + group * kLaneCount);
    }
};

/// Gathers surroundings of one point after the other along the curve on which the points lie: one search fetches what
/// is round a block of them, and of that each takes its own. One object a thread.
class Gatherer {
public:
    /// @param points as they now are
    /// @param places where search has them: what is near is decided by these
    /// @param reaches [points], 0: no surroundings are wanted
    Gatherer(const Points& points, const std::vector<Vec3f>& places, const NearestSearch& search,
             const std::vector<float>& reaches);

    /// Calls body(point, surroundings) for each point of a block with a reach above 0. Of what is nearer than its reach
    /// a point's surroundings hold what faces the same way, itself included; 192 of them at most, spread evenly.
    template <typename Body>
    void forBlock(std::size_t block, const Body& body) {
        const std::size_t begin = block * kBlock, end = std::min(points_.size(), begin + kBlock);
        forRun(begin, end, body);
    }

    static std::size_t blockCount(std::size_t points) { return (points + kBlock - 1) / kBlock; }

private:
    static constexpr std::size_t kBlock = 16;

    template <typename Body>
    void forRun(std::size_t begin, std::size_t end, const Body& body) {
        if (!fetchRun(begin, end)) {
            forRun(begin, (begin + end) / 2, body);
            forRun((begin + end) / 2, end, body);
            return;
        }
        for (std::size_t i = begin; i < end; ++i)
            if (reaches_[i] > 0) {
                gather(i);
                body(i, around_);
            }
    }

    bool fetchRun(std::size_t begin, std::size_t end);
    void gather(std::size_t point);
    void sortByPlace(std::size_t point, std::size_t count);
    void measure(const Vec3f& from);
    std::size_t keepNear(std::size_t point);
    void fill(std::size_t point);

    const Points& points_;
    const std::vector<Vec3f>& places_;
    const NearestSearch& search_;
    const std::vector<float>& reaches_;
    std::vector<std::uint32_t> found_;
    std::size_t found_count_ = 0;
    std::vector<float> x_, y_, z_, squared_;
    std::vector<std::uint32_t> kept_;
    std::vector<std::tuple<std::uint64_t, float, std::uint32_t>> order_; ///< of those in kept_: cell, distance, place
    Surroundings around_;
};

} // namespace pointrt::surface
