// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/voronoi_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointrt::surface {

namespace {

float radiusOf(const std::vector<CellCorner>& corners) {
    float squared = 0;
    for (const CellCorner& corner : corners) squared = std::max(squared, corner.place.squaredNorm());
    return std::sqrt(squared);
}

} // namespace

void VoronoiCell::reset(float half_edge) {
    corners_.clear();
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        corners_.push_back({Eigen::Vector2f(float(x), float(y)) * half_edge, true, false});
    radius_ = radiusOf(corners_);
}

bool VoronoiCell::clip(const Eigen::Vector2f& place, float height) {
    const float limit = (place.squaredNorm() + height * height) / 2;
    along_.resize(corners_.size());
    float farthest = -std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        along_[i] = corners_[i].place.dot(place);
        farthest = std::max(farthest, along_[i]);
    }
    // Ignores cuts within rounding: slivers would count as closed corners.
    constexpr float kRounding = 1e-5f;
    if (farthest - limit <= kRounding * (limit + radius_ * place.norm())) return false;
    cutOff(limit);
    return true;
}

void VoronoiCell::cutOff(float limit) {
    clipped_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const std::size_t next = i + 1 < corners_.size() ? i + 1 : 0;
        const CellCorner& from = corners_[i];
        const float from_beyond = along_[i] - limit, to_beyond = along_[next] - limit;
        if (from_beyond <= 0) clipped_.push_back(from);
        if ((from_beyond > 0) == (to_beyond > 0)) continue;
        const float share = from_beyond / (from_beyond - to_beyond);
        // Where the outline leaves, a new edge along the bisector begins; where it enters, the old edge continues.
        const bool border_edge = from_beyond > 0 && from.border_edge;
        clipped_.push_back({from.place + share * (corners_[next].place - from.place), border_edge, false});
    }
    corners_.swap(clipped_);
    radius_ = radiusOf(corners_);
}

bool VoronoiCell::isOpen() const {
    return std::any_of(corners_.begin(), corners_.end(), [](const CellCorner& corner) { return corner.border_edge; });
}

} // namespace pointrt::surface
