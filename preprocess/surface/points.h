// SPDX-License-Identifier: GPL-3.0-or-later
// The points that all stages work on: distinct, along a Morton curve, of a size that float likes.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::surface {

/// Optional arrays are empty or as long as positions.
struct Points {
    /// Cloud position times 2^-scale_exponent, so that the longest edge of the bounding box is in [0.5, 1):
    /// squared distances can then neither overflow nor vanish.
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; ///< unit length, or zero where none is given
    std::vector<Rgb8> colors;
    std::vector<std::uint32_t> sensor_of_point; ///< index into sensors, or kNoSensor
    std::vector<Vec3f> sensors;                 ///< in the unit of positions
    std::vector<float> radii;                   ///< as given, in the unit of positions; 0 where missing
    std::vector<float> noise;                   ///< as given, in the unit of positions; 0 where not known
    std::vector<std::uint32_t> input_index;     ///< index in the cloud
    Vec3f up = Vec3f::Zero();                   ///< zero: not known
    bool from_above = false;                    ///< every surface was seen from up
    int scale_exponent = 0;

    std::size_t size() const { return positions.size(); }
    /// Whether the point came with the radius of its disc, as Gaussians and surfels do: it is no sample of a surface,
    /// but a piece of one.
    bool hasRadius(std::size_t point) const { return !radii.empty() && radii[point] > 0; }
    /// The point's sensor, or nullptr.
    const Vec3f* sensorOf(std::size_t point) const;
};

/// Sorts the cloud along a Morton curve and merges points at exactly equal positions: the first in the cloud stays,
/// with its own attributes. Empties the cloud array by array. Positions must be finite and not all equal.
Points takePoints(Cloud&& cloud);

/// Keeps the points whose flag is set, in order.
void keepPoints(Points& points, const std::vector<std::uint8_t>& keep);

/// Where the points fill less than 1/64 of the unit, because strays far away are gone: gives them the size and the
/// order that takePoints would have. Returns whether it did; points are numbered anew then.
bool refit(Points& points);

} // namespace pointrt::surface
