// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/voronoi_cell.h"

#include <algorithm>
#include <cmath>

namespace pointrt::surface {

void VoronoiCell::reset(float half_edge) {
    corners_.clear();
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        corners_.push_back({Eigen::Vector2f(float(x), float(y)) * half_edge, true, false});
}

bool VoronoiCell::clip(const Eigen::Vector2f& place, float height) {
    const float limit = (place.squaredNorm() + height * height) / 2;
    const auto beyond = [&](const CellCorner& corner) { return corner.place.dot(place) - limit; };
    // Less than rounding may amount to is not worth a cut: slivers would count as closed corners.
    constexpr float kRounding = 1e-5f;
    const float hair = kRounding * (limit + reach() * place.norm());
    if (std::none_of(corners_.begin(), corners_.end(), [&](const auto& corner) { return beyond(corner) > hair; }))
        return false;

    clipped_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const CellCorner& from = corners_[i];
        const CellCorner& to = corners_[(i + 1) % corners_.size()];
        const float from_beyond = beyond(from), to_beyond = beyond(to);
        if (from_beyond <= 0) clipped_.push_back(from);
        if ((from_beyond > 0) == (to_beyond > 0)) continue;
        const float share = from_beyond / (from_beyond - to_beyond);
        // Leaving, the new edge runs along the bisector; entering, the old edge goes on.
        const bool border_edge = from_beyond > 0 && from.border_edge;
        clipped_.push_back({from.place + share * (to.place - from.place), border_edge, false});
    }
    corners_.swap(clipped_);
    return true;
}

float VoronoiCell::reach() const {
    float squared = 0;
    for (const CellCorner& corner : corners_) squared = std::max(squared, corner.place.squaredNorm());
    return std::sqrt(squared);
}

float VoronoiCell::closedReach(float limit) const {
    float farthest = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const CellCorner& before = corners_[(i + corners_.size() - 1) % corners_.size()];
        const float distance = corners_[i].place.norm();
        if (!corners_[i].border_edge && !before.border_edge && distance <= limit)
            farthest = std::max(farthest, distance);
    }
    return farthest;
}

} // namespace pointrt::surface
