// SPDX-License-Identifier: Apache-2.0
// The rays that sample the footprint of a laser beam.
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/util/vec.h"

namespace pointrt {

/// Rays with equal shares of a Gaussian beam's power, within the cone where intensity falls to 1 / e^2 of that on the
/// axis.
class BeamFootprint {
public:
    /// @param count of rays; 1: only the axis
    BeamFootprint(double divergence_mrad, std::size_t count);

    std::size_t size() const { return tangents_.size(); }

    /// The frame of a beam, which is the axis of the spiral of rays.
    struct Around {
        /// @param axis unit length
        /// @param start rotation of the spiral, 0 to 1 for a full circle
        Around(Vec3 axis, double start);
        Vec3 axis, u, v; ///< orthonormal
        double angle;
    };
    /// Direction of ray i, unit length.
    Vec3 ray(const Around& around, std::size_t i) const;

private:
    std::vector<double> tangents_; ///< of the angles to the axis
};

} // namespace pointrt
