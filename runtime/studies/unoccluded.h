// SPDX-License-Identifier: Apache-2.0
// Which visibility rays are unoccluded.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pointrt/trace.hpp"
#include "runtime/studies/visibility_ray.h"

namespace pointrt {

/// Two of the library's chunks, to keep two slots busy; some 100 MB with intermediate arrays.
constexpr std::size_t kRaysAtOnce = std::size_t{1} << 19;

/// Writes 1 for each ray that hits nothing but its own surface, else 0. Either all rays have a finite length, or none.
/// @return the number of rays cast
std::uint64_t findUnoccluded(const TraceScene& scene, std::span<const VisibilityRay> rays,
                             std::span<std::uint8_t> unoccluded);

} // namespace pointrt
