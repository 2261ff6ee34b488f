// SPDX-License-Identifier: GPL-3.0-or-later
// The points that all stages work on: distinct, along a Morton curve, scaled to unit size, with all that is known of
// each.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::surface {

/// All per-point values, one array each. Every array but positions and input_index may be empty; all others have the
/// same length. Row operations (keepRows ...) change all of them alike.
struct PointColumns {
    /// Cloud position times 2^-scale_exponent, so that the longest edge of the bounding box is in [0.5, 1):
    /// squared distances can then neither overflow nor vanish. All other lengths are in this unit, too.
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; ///< unit length, or zero if none was given
    std::vector<Rgb8> colors;
    std::vector<std::uint32_t> sensor_of_point; ///< index into sensors, or kNoSensor
    std::vector<float> given_radii;             ///< disc radius from the input; 0 if missing
    std::vector<float> given_noise;             ///< the device's standard deviation; 0 if unknown
    std::vector<std::uint32_t> input_index;     ///< index in the cloud

    // the following are computed step by step
    std::vector<std::uint8_t> side_known; ///< 1: the normal points out before normals are oriented
    std::vector<std::uint32_t> scan_of_point;
    std::vector<std::uint8_t> at_silhouette; ///< 1: flagged by flagSilhouettes
    std::vector<float> planarity;            ///< planarity weight (planarity.h); empty: 1 everywhere
    std::vector<float> noise;                ///< standard deviation across the surface; empty if all scans are clean
    std::vector<float> support;              ///< share of the neighbourhood on the surface, from projectPoints
    std::vector<float> radii;                ///< radius of the point's disc

    auto columns() {
        return std::tie(positions, normals, colors, sensor_of_point, given_radii, given_noise, input_index, side_known,
                        scan_of_point, at_silhouette, planarity, noise, support, radii);
    }
};
static_assert(sizeof(PointColumns) ==
                  std::tuple_size_v<decltype(PointColumns().columns())> * sizeof(std::vector<float>),
              "columns() must list every array");

struct PointSet : PointColumns {
    std::vector<Vec3f> sensors; ///< scanner positions
    Vec3f up = Vec3f::Zero();   ///< unit length; zero: unknown
    bool from_above = false;    ///< airborne: every surface was seen from above
    int scale_exponent = 0;

    std::size_t size() const { return positions.size(); }
    /// Whether the input gave the radius of the point's disc, as for Gaussians and surfels: then it is not a sample of
    /// a surface, but a piece of one.
    bool hasGivenRadius(std::size_t point) const { return !given_radii.empty() && given_radii[point] > 0; }
    /// The point's sensor, or nullptr.
    const Vec3f* sensorOf(std::size_t point) const;
};

/// Keeps the points whose flag is set, in order.
void keepRows(PointSet& points, const std::vector<std::uint8_t>& keep);

/// Appends copies of these points, in this order.
void appendRows(PointSet& points, const std::vector<std::uint32_t>& rows);

/// Replaces the points by these, in this order. Needs memory for a copy of the largest column.
void selectRows(PointSet& points, const std::vector<std::uint32_t>& rows);

/// Sorts the cloud along a Morton curve and merges points at exactly equal positions: the first in the cloud stays,
/// with its own attributes. Moves the arrays out of the cloud. Positions must be finite and not all equal.
/// @param left_out indices in the cloud, ascending, of points to drop
PointSet takePoints(Cloud&& cloud, const std::vector<std::uint32_t>& left_out = {});

/// Gives the points the scale and order that takePoints would, if they fill less than 1/64 of the unit because distant
/// outliers were removed. Returns whether it did: indices of points change then.
bool refit(PointSet& points);

} // namespace pointrt::surface
