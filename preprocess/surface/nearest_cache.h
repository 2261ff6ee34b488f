// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest-point searches for a sequence of places that are near each other.
#pragma once

#include "preprocess/surface/candidates.h"

namespace pointrt::surface {

/// Finds the points nearest to each of a sequence of places, each near the one before, as along a Morton curve: holds
/// the points around one place, and chooses among them until a place comes too near their border. Results equal those
/// of NearestSearch::nearest, ties included, unless more points coincide with the place than are wanted. Use one object
/// per thread.
class NearestCache {
public:
    /// Both must outlive the cache; positions are those that search was built over.
    NearestCache(const NearestSearch& search, const std::vector<Vec3f>& positions);

    /// As NearestSearch::nearest.
    std::size_t nearest(const Vec3f& query, std::span<std::uint32_t> indices, std::span<float> squared_distances,
                        float squared_limit = std::numeric_limits<float>::max());

private:
    bool chooseHeld(const Vec3f& query, std::size_t wanted, float squared_limit);
    void hold(const Vec3f& center, float radius);

    const NearestSearch& search_;
    const std::vector<Vec3f>& positions_;
    Candidates held_;
    Vec3f center_ = Vec3f::Zero();
    float reach_ = 0; ///< all points nearer to center_ are held
};

} // namespace pointrt::surface
