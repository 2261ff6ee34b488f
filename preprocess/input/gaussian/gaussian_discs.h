// SPDX-License-Identifier: GPL-3.0-or-later
// Discs in place of Gaussians.
#pragma once

#include "preprocess/input/gaussian/gaussians.h"

namespace pointrt {

/// Radius of a disc in standard deviations: the viewer blends discs with the weight (1 - d^2 / r^2)^2, which falls to a
/// half where exp(-d^2 / 2) does when r is sqrt(2 ln 2) / sqrt(1 - sqrt(1/2)) = 2.18. At its rim the Gaussian covers 9
/// %.
inline constexpr float kRadiusDeviations = 2.2f;

/// The disc across a Gaussian's shortest axis.
struct GaussianDisc {
    Vec3f normal = Vec3f::Zero(); ///< unit length, either sign; zero if the Gaussian has no rotation
    float radius = 0;
    bool is_flat = false; ///< the shortest axis is much shorter than the next one
};

/// The disc of a Gaussian; all zero if the deviations are not finite.
GaussianDisc discOf(const Gaussian& gaussian);

/// readGaussianScan for a sink that wants discs: one for each Gaussian that is opaque enough and smaller than a sky,
/// with attribute "opacity".
void readAsDiscs(const InputFile& input, const GaussianFile& file, const EachGaussian& each, Sink& sink,
                 const std::string& title);

} // namespace pointrt
