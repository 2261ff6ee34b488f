// SPDX-License-Identifier: Apache-2.0
// Splats of instances as points in world coordinates.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pointrt/pro.hpp"
#include "pointrt/studies.hpp"
#include "runtime/cast/cast_instance.h"

namespace pointrt {

/// Opens the file of an instance; checks tiles against their set. Throws Error.
ProFile openInstance(const InstanceList& list, const CastInstance& instance);

/// Throws Error kBadInput if a tile has another number of points than its set states.
void requireCount(const InstanceList& list, const CastInstance& instance, std::uint64_t points);

/// Appends a splat of the file in world coordinates; with noise if this file or an earlier one has noise.
void addPoint(const ProFile& file, std::size_t splat, const Placement& placement, ScanPoints& points);

} // namespace pointrt
