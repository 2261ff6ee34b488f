// SPDX-License-Identifier: Apache-2.0
// Checks points that are to be measured.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pointrt/measure.hpp"
#include "runtime/util/vec.h"

namespace pointrt {

/// Throws TraceError kBadUsage.
[[noreturn]] void refuseMeasure(const std::string& reason);

/// Throws TraceError kBadUsage for fewer than least points: "a circle needs 3 points or more, not 2".
/// @param what is measured: "a circle"
void requireCount(std::span<const Position> points, std::size_t least, const std::string& what);

/// Throws as requireCount does, also "point N is not finite" with N from 1.
std::vector<Vec3> vectorsOf(std::span<const Position> points, std::size_t least, const std::string& what);

} // namespace pointrt
