// SPDX-License-Identifier: Apache-2.0
// The rays that a beam is traced with.
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/util/vec.h"

namespace pointrt {

/// Rays that hold equal shares of a Gaussian beam's power within the cone where it falls to 1 / e^2 of the middle's.
class LidarSpot {
public:
    /// @param count 1 is the axis alone
    LidarSpot(double divergence_mrad, std::size_t count);

    std::size_t size() const { return aside_.size(); }

    /// How the spiral lies around a beam.
    struct Around {
        /// axis: unit length. turn: from 0 to 1, where on its circle the spiral begins.
        Around(Vec3 axis, double turn);
        Vec3 axis, u, v; ///< at right angles, unit length
        double angle;
    };
    /// Direction of ray i, unit length.
    Vec3 ray(const Around& around, std::size_t i) const;

private:
    std::vector<double> aside_; ///< tangents of the angles to the axis
};

} // namespace pointrt
