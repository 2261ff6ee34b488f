// SPDX-License-Identifier: Apache-2.0
// Internal to runtime/studies: vectors of the public interface, and errors for invalid values.
#pragma once

#include <numbers>
#include <string>

#include "pointrt/trace.hpp"
#include "runtime/util/vec_array.h"

namespace pointrt {

/// Angle between consecutive points of Vogel's spiral ("A better way to construct the sunflower head", 1979).
constexpr double kGoldenAngle = 2 * std::numbers::pi * (2 - std::numbers::phi);

[[noreturn]] inline void refuseUsage(const std::string& reason) {
    throw TraceError(TraceError::Kind::kBadUsage, reason);
}

} // namespace pointrt
