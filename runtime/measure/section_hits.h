// SPDX-License-Identifier: Apache-2.0
// Points where a plane cuts surfaces, made into lines.
#pragma once

#include <span>
#include <vector>

#include "runtime/measure/plane_line.h"

namespace pointrt {

struct SectionHit {
    Vec2 at;
    Vec2 along; ///< tangent of the cut there, unit length, of either sign
};

/// Merges hits on the same piece of a line: less than 0.6 steps apart along it and a step across.
std::vector<SectionHit> thinHits(std::span<const SectionHit> hits, double step);

/// Links hits that follow each other, up to 2.5 steps apart, the nearest first; each has at most one neighbour on
/// either side. Hits without a neighbour are left out.
std::vector<PlaneLine> linkHits(std::span<const SectionHit> hits, double step);

/// Joins ends of lines that lie no farther apart than gap if one line continues the other straight, or if both meet in
/// a corner when extended by at most gap. Ends that overshoot a corner are cut off.
std::vector<PlaneLine> joinEnds(std::vector<PlaneLine> lines, double step, double gap);

/// Simplifies a line: no given point is farther from the result than tolerance (Douglas and Peucker 1973). Corners are
/// where the least-squares fits of the straight pieces between them cross, which averages noise.
PlaneLine simplified(const PlaneLine& line, double tolerance);

} // namespace pointrt
