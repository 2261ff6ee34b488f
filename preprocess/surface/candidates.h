// SPDX-License-Identifier: GPL-3.0-or-later
// The points within a ball, of which those nearest to any place in it are chosen without another search.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/surface/neighbors.h"

namespace pointrt::surface {

/// Far above the rounding error of a distance, 2^-22 of it.
constexpr float kDistanceMargin = 1.0001f;

/// Points around a place, as a struct of arrays, which compilers vectorise. Use one object per thread.
class Candidates {
public:
    explicit Candidates(std::size_t most);

    /// Holds all points nearer to center than radius. Returns false if there are more than `most`: then it is unusable.
    bool fetch(const NearestSearch& search, const std::vector<Vec3f>& positions, const Vec3f& center, float radius);

    /// Chooses the points whose squared distance from a place is at most squared_radius, sorted by distance, then
    /// index. May leave out some that are farther than the first `wanted`. Returns their number.
    std::size_t choose(const Vec3f& from, float squared_radius, std::size_t wanted);

    std::span<const std::uint32_t> chosen() const { return {sorted_indices_.data(), kept_count_}; }
    std::span<const float> chosenSquared() const { return {sorted_.data(), kept_count_}; }

private:
    void measure(const Vec3f& from);
    void keepWithin(float squared_radius);
    void thinKept(float squared_radius, std::size_t wanted);
    void sortKept();

    std::vector<std::uint32_t> indices_;
    std::vector<float> x_, y_, z_, squared_;
    std::size_t count_ = 0;
    std::vector<float> kept_, sorted_;
    std::vector<std::uint32_t> kept_indices_, sorted_indices_;
    std::vector<std::uint16_t> used_; ///< [ranks], number of points with that rank
    std::size_t kept_count_ = 0;
};

} // namespace pointrt::surface
