// SPDX-License-Identifier: Apache-2.0
// Which rays off surfaces get where they are going.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pointrt/trace.hpp"
#include "runtime/studies/departure.h"

namespace pointrt {

/// Two chunks of the library's, which keep two slots at work; some 100 MB with what is made of them.
constexpr std::size_t kDeparturesAtOnce = std::size_t{1} << 19;

/// 1 for each ray that meets nothing but its own surface, else 0. Either all rays end, or none does.
/// @return rays that were cast
std::uint64_t findOpen(const TraceScene& scene, std::span<const Departure> rays, std::span<std::uint8_t> open);

} // namespace pointrt
