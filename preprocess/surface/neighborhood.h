// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbourhoods by radius, gathered for many points at once.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Values processed at once: two vector registers of any x86-64.
using Lanes = Eigen::Array<float, 8, 1>;
constexpr std::size_t kLaneCount = 8;

/// The neighbours of a point, relative to it, with its support radius as the unit of length. Padded to full lanes with
/// neighbours of weight 0.
struct Neighborhood {
    std::size_t count = 0;
    std::vector<float> x, y, z, nx, ny, nz;
    /// (1 - d^2)^4 of the distance d: 0 at the support radius, with slope 0 (Guennebaud and Gross 2007).
    std::vector<float> weight;
    std::vector<std::uint32_t> indices; ///< [count]

    std::size_t laneGroups() const { return (count + kLaneCount - 1) / kLaneCount; }
    static Lanes lanes(const std::vector<float>& values, std::size_t group) {
        return Eigen::Map<const Lanes>(values.data() + group * kLaneCount);
    }
};

/// Gathers the neighbourhoods of points in the order of their Morton curve: one search fetches the candidates around a
/// block of points, from which each takes its own. Use one object per thread.
class NeighborhoodGatherer {
public:
    /// @param points with their current positions
    /// @param places positions that search was built over, by which candidates are found
    /// @param radii [points], support radii; 0: skip the point
    NeighborhoodGatherer(const PointSet& points, const std::vector<Vec3f>& places, const NearestSearch& search,
                         const std::vector<float>& radii);

    /// Calls body(point, neighborhood) for each point of a block with a radius above 0. Its neighbourhood holds the
    /// points within that radius that face the same way, itself included: at most 192, spread evenly.
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
            if (radii_[i] > 0) {
                gather(i);
                body(i, around_);
            }
    }

    bool fetchRun(std::size_t begin, std::size_t end);
    void gather(std::size_t point);
    void sortByCell(std::size_t point, std::size_t count);
    void measure(const Vec3f& from, const Vec3f& normal);
    std::size_t keepNear(float squared_radius);
    void fill(std::size_t point);

    const PointSet& points_;
    const std::vector<Vec3f>& places_;
    const NearestSearch& search_;
    const std::vector<float>& radii_;
    std::vector<std::uint32_t> found_;
    std::size_t found_count_ = 0;
    std::vector<float> x_, y_, z_, nx_, ny_, nz_, squared_, cosines_;
    std::vector<std::uint32_t> kept_;
    std::vector<std::uint64_t> keys_, sorted_keys_; ///< of kept_, for sortByCell
    Neighborhood around_;
};

} // namespace pointrt::surface
