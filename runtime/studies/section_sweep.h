// SPDX-License-Identifier: Apache-2.0
// Rays in a plane, and their hits.
#pragma once

#include <vector>

#include "pointrt/measure.hpp"
#include "runtime/measure/section_hits.h"

namespace pointrt {

/// The points where rays in the plane hit surfaces, in the plane's axes. Rays run along both axes, a step apart, in
/// both directions and through all surfaces, so that noise in front of a surface and behind it cancels. Throws
/// TraceError kBadUsage for more than 2^22 rays.
std::vector<SectionHit> sweepPlane(const TraceScene& scene, const SectionPlane& plane, double step);

} // namespace pointrt
