// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/nearest_cache.h"

#include <algorithm>
#include <cmath>

namespace pointrt::surface {
namespace {

/// Radius of the points held over the distance of the farthest that was found: 4 times as many on a surface, 8 times in
/// space.
constexpr float kHeldOverFound = 2;

/// At most 24 points are wanted (surround.cpp): 8 times as many, with room for uneven densities.
constexpr std::size_t kMostHeld = 512;

} // namespace

NearestCache::NearestCache(const NearestSearch& search, const std::vector<Vec3f>& positions)
    : search_(search), positions_(positions), held_(kMostHeld) {}

/// Chooses among the points held; false if others may be nearer.
bool NearestCache::chooseHeld(const Vec3f& query, std::size_t wanted, float squared_limit) {
    const float sure = reach_ - distanceBetween(query, center_), squared_sure = sure * sure;
    if (!(sure > 0) || squared_sure < std::numeric_limits<float>::min()) return false;
    const float below_limit = std::nextafter(squared_limit, 0.0f);
    const std::size_t chosen = held_.choose(query, std::min(squared_sure, below_limit), wanted);
    return chosen >= wanted || below_limit <= squared_sure;
}

void NearestCache::hold(const Vec3f& center, float radius) {
    const bool fits = std::isfinite(radius) && held_.fetch(search_, positions_, center, radius);
    center_ = center;
    reach_ = fits ? radius / kDistanceMargin : 0;
}

std::size_t NearestCache::nearest(const Vec3f& query, std::span<std::uint32_t> indices,
                                  std::span<float> squared_distances, float squared_limit) {
    const std::size_t wanted = indices.size();
    if (chooseHeld(query, wanted, squared_limit)) {
        const std::size_t count = std::min(wanted, held_.chosen().size());
        std::copy_n(held_.chosen().begin(), count, indices.begin());
        std::copy_n(held_.chosenSquared().begin(), count, squared_distances.begin());
        return count;
    }
    const std::size_t count = search_.nearest(query, indices, squared_distances, squared_limit);
    hold(query, kHeldOverFound * std::sqrt(count == wanted ? squared_distances.back() : squared_limit));
    return count;
}

} // namespace pointrt::surface
