// SPDX-License-Identifier: Apache-2.0
// Splats of what rays are held against as points of the world.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pointrt/pro.hpp"
#include "pointrt/studies.hpp"
#include "runtime/cast/target.h"

namespace pointrt {

/// A target's file; a tile is held against what its set says. Throws Error, its code as the format's library has it.
ProFile openTarget(const TargetList& list, const Target& target);

/// That a target's points are as many as its set says; others have as many as they have. Throws Error kBadInput.
void requireCount(const TargetList& list, const Target& target, std::uint64_t points);

/// Adds a splat of the file as it stands in the world. Noise is added where the file, or those before, have some.
void addPoint(const ProFile& file, std::size_t splat, const Placement& placement, ScanPoints& points);

} // namespace pointrt
