// SPDX-License-Identifier: Apache-2.0
// A few splats that stand for all scans of a scene.
#pragma once

#include <array>
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
    bool oriented = false;
    bool furnished = false; ///< shapes stand in the scene besides its scans
};

/// Ends of a range of numbers.
struct Extent {
    double low = 0, high = 0;
    double size() const { return high - low; }
    double middle() const { return (low + high) / 2; }
};

/// All values but strays: 99.8% of them; 95% where those take less than 0.35 of that.
/// values: at least one; they are put in another order.
Extent extentWithoutStrays(std::vector<double>& values);

/// Luminance of the reflectance that a twentieth of the sample exceeds; 0.5 of an empty one.
double brightReflectance(const SceneSample& sample);

/// The corners of a box around all splats but strays, along the axes. sample: not empty
struct SampleBox {
    Vec3 low, high;
};
SampleBox boxWithoutStrays(const SceneSample& sample);
/// The same of the inner 95% along each axis: of what was seen through windows, too.
SampleBox denseBox(const SceneSample& sample);

} // namespace pointrt
