// SPDX-License-Identifier: GPL-3.0-or-later
// A point's Voronoi cell in its tangent plane, by clipping a square.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace pointrt::surface {

/// Corner of a cell, and the edge from it to the next corner counter-clockwise.
struct CellCorner {
    Eigen::Vector2f place;    ///< in the tangent plane, relative to the point
    bool border_edge = false; ///< the edge is part of the initial square, not of a bisector
    bool verified = false;    ///< no other point is nearer to the corner
};

/// Convex polygon around the origin.
class VoronoiCell {
public:
    /// Starts with a square of this half edge; half_edge > 0.
    void reset(float half_edge);

    /// Cuts off the part nearer to a neighbour than to the point. place is the neighbour's projection into the plane,
    /// height its distance from it: the bisector of both points in space meets the plane at
    /// (|place|^2 + height^2) / (2 |place|), so that neighbours around an edge cut at the edge.
    /// Returns whether anything was cut off.
    bool clip(const Eigen::Vector2f& place, float height);

    const std::vector<CellCorner>& corners() const { return corners_; }
    void markVerified(std::size_t corner) { corners_[corner].verified = true; }

    /// Distance to the farthest corner.
    float radius() const { return radius_; }
    /// Distance to the farthest corner within limit where two bisectors meet and counts(place) is true; 0 if there is
    /// none.
    template <typename Counts>
    float closedRadius(float limit, const Counts& counts) const {
        float farthest = 0;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const CellCorner& before = corners_[(i + corners_.size() - 1) % corners_.size()];
            const float distance = corners_[i].place.norm();
            if (corners_[i].border_edge || before.border_edge || distance > limit || distance <= farthest) continue;
            if (counts(corners_[i].place)) farthest = distance;
        }
        return farthest;
    }
    /// Whether a part of the square's outline is left, where no neighbour bounds the cell.
    bool isOpen() const;

private:
    /// Replaces the corners beyond a bisector (at least one) by its intersections with the cell's edges.
    void cutOff(float limit);

    std::vector<CellCorner> corners_, clipped_;
    std::vector<float> along_; ///< dot products of the corners with the place last clipped by
    float radius_ = 0;
};

} // namespace pointrt::surface
