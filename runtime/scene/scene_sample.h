// SPDX-License-Identifier: Apache-2.0
// A sample of a scene's splats, for framing and lighting.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/util/vec.h"

namespace pointrt {

struct SampledSplat {
    Vec3 position, normal; ///< world units; unit length, outward if the sample is oriented; 0 for a ball
    double radius = 0;
    std::array<float, 3> color{}; ///< reflectance, linear
};

struct SceneSample {
    std::vector<SampledSplat> splats; ///< each represents the same number of splats
    std::vector<Vec3> sensors;        ///< positions of scanners
    std::vector<Vec3> zeros;          ///< origins of the files' coordinates, where the scanner is in unregistered scans
    bool oriented = false;
    bool has_shapes = false; ///< the scene has shapes besides its scans
};

/// Samples of fewer splats have no strays: every splat counts.
constexpr std::size_t kEachCounts = 100;

/// A range of numbers.
struct Extent {
    double low = 0, high = 0;
    double size() const { return high - low; }
    double middle() const { return (low + high) / 2; }
};

/// The range without a thousandth of the values at each end. values: not empty; reordered.
Extent extentOfMost(std::vector<double>& values);

/// Half the extent of a disc or ball along an axis of unit length.
double halfExtentAlong(const SampledSplat& splat, Vec3 axis);

/// The 95th percentile of the luminance of reflectance; 0.5 for an empty sample.
double brightReflectance(const SceneSample& sample);

/// The mean luminance of reflectance; 0.5 for an empty sample.
double meanReflectance(const SceneSample& sample);

/// The lowest point along up (unit length) of the discs of a sample without its strays. None if up is along an axis, as
/// the bounding box then gives it, or if the sample is empty.
std::optional<double> lowestIfTilted(const SceneSample& sample, Vec3 up);

/// An axis-aligned box.
struct SampleBox {
    Vec3 low, high;
};
/// The bounds of the splats' centres. sample: not empty
SampleBox boundsOf(const SceneSample& sample);
/// The bounds of the splats' discs. sample: not empty
SampleBox discBounds(const SceneSample& sample);
/// The bounds of the inner 95% along each axis. sample: not empty
SampleBox denseBox(const SceneSample& sample);

/// The largest connected part, and other parts that are near or large: a part that holds 5% of the sample may enlarge
/// the diagonal of the box by 100%, smaller parts by proportionally less. This keeps the tip of a tree, however few
/// splats it has, but not the sparse far surroundings in a street scan. Samples below kEachCounts are kept whole.
SceneSample withoutStrays(const SceneSample& sample);

} // namespace pointrt
