// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussians of a radiance field to the discs that lie in their surfaces.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>

#include "preprocess/input/sink.h"

namespace pointrt {

/// One Gaussian, as all formats of them give it.
struct Gaussian {
    Vec3d position = Vec3d::Zero();
    Vec3f deviations = Vec3f::Zero(); ///< along its axes; 0 along the third where it has two, as 2D Gaussians do
    Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity(); ///< of its axes, any length
    float opacity = 1;                                            ///< at its centre, 0 to 1
    Vec3f color = Vec3f::Zero();                                  ///< sRGB, 0 to 1: what it shows from all sides
};

/// The constant term of the real spherical harmonics, 1 / (2 sqrt(pi)): colours are stored around grey, in it.
inline constexpr double kConstantHarmonic = 0.28209479177387814;

inline float sigmoid(float value) { return 1 / (1 + std::exp(-value)); }

/// Calls its argument with each Gaussian of a file, in order; as often as it is called itself.
using EachGaussian = std::function<void(const std::function<void(const Gaussian&)>&)>;

struct GaussianFile {
    std::uint64_t count = 0;
    Vec3d up = Vec3d::Zero(); ///< as the format or its programs have it
    std::string lost;         ///< what else the file has of them, that discs have not; ""
};

/// Reads a file of Gaussians as one scan: a disc for each that is opaque enough, with attribute "opacity". A note says
/// what was left out and lost. Throws Error when nothing is left.
void readGaussians(const Source& source, const GaussianFile& file, const EachGaussian& each, Sink& sink);

} // namespace pointrt
