// SPDX-License-Identifier: Apache-2.0
// A few splats that stand for all scans of a scene.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "runtime/util/vec.h"

namespace pointrt {

struct SampledSplat {
    Vec3 position, normal; ///< world units; unit length, pointing out where the sample is oriented
    double radius = 0;
    std::array<float, 3> color{}; ///< reflectance, linear
};

struct SceneSample {
    std::vector<SampledSplat> splats; ///< each stands for as many
    std::vector<Vec3> sensors;        ///< where scanners stood
    std::vector<Vec3> zeros;          ///< of the files' coordinates: a scanner's place where nobody has moved its scan
    bool oriented = false;
    bool furnished = false; ///< shapes stand in the scene besides its scans
};

/// Of fewer splats each is one that somebody looks for: none is a stray, and all of its disc is to be seen.
constexpr std::size_t kEachCounts = 100;

/// Ends of a range of numbers.
struct Extent {
    double low = 0, high = 0;
    double size() const { return high - low; }
    double middle() const { return (low + high) / 2; }
};

/// All values but a thousandth at each end. values: at least one; they are put in another order.
Extent extentOfMost(std::vector<double>& values);

/// How far a disc reaches from its middle along an axis of unit length.
double reachAlong(const SampledSplat& splat, Vec3 axis);

/// Luminance of the reflectance that a twentieth of the sample exceeds; 0.5 of an empty one.
double brightReflectance(const SceneSample& sample);

/// The corners of a box along the axes.
struct SampleBox {
    Vec3 low, high;
};
/// Around the middles of all splats. sample: not empty
SampleBox boundsOf(const SceneSample& sample);
/// Around their discs.
SampleBox discBounds(const SceneSample& sample);
/// Around the inner 95% along each axis. sample: not empty
SampleBox denseBox(const SceneSample& sample);

/// The part that hangs together and holds most, and what else there is of it near by or plenty: what doubles the box
/// around all is a twentieth of the sample or more. A tree's tip is of the tree, however few splats it has; the thin
/// fringe of what a spinning scanner saw is not of the street. Below kEachCounts it is all.
SceneSample withoutStrays(const SceneSample& sample);

} // namespace pointrt
