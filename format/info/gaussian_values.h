// SPDX-License-Identifier: Apache-2.0
// Values of Gaussians in the conventions of other programs' files.
#pragma once

#include <cstddef>

#include "format/base/harmonic_degree.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// The coefficient of the constant harmonic, 1 / (2 sqrt(pi)), of a display-encoded colour around grey.
inline double constantHarmonic(float color) {
    constexpr double kConstantHarmonic = 0.28209479177387814;
    return (double{color} - 0.5) / kConstantHarmonic;
}

/// A coordinate of the mean, input units. @param axis 0 to 2
inline double inputCoordinate(const ProFile& file, const pro_gaussian& gaussian, int axis) {
    return file.info().origin[axis] + file.info().scale * gaussian.mean[axis];
}

/// The value of a harmonic code. @param coefficient 0 to 14, without the constant one
inline float harmonicValue(const ProFile& file, std::int8_t code, std::uint32_t coefficient) {
    return static_cast<float>(code) / PRO_HARMONIC_STEPS *
           file.gaussians()->harmonic_max[degreeOfHarmonic(coefficient) - 1];
}

} // namespace pointrt
