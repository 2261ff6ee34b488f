// SPDX-License-Identifier: GPL-3.0-or-later
// Converts Gaussians of a radiance field to discs.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>

#include "preprocess/ingest/sink.h"

namespace pointrt {

/// One Gaussian.
struct Gaussian {
    Vec3d position = Vec3d::Zero();
    Vec3f deviations = Vec3f::Zero(); ///< along its axes; 0 along the third axis of 2D Gaussians
    Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity(); ///< of its axes, any length
    float opacity = 1;                                            ///< at its centre, 0 to 1
    Vec3f color = Vec3f::Zero();                                  ///< sRGB, 0 to 1: the view-independent part
};

/// The constant term of the real spherical harmonics, 1 / (2 sqrt(pi)): colours are stored as its multiples around
/// grey.
inline constexpr double kConstantHarmonic = 0.28209479177387814;

inline float sigmoid(float value) { return 1 / (1 + std::exp(-value)); }

/// Calls its argument with each Gaussian of a file, in order; may be called repeatedly.
using EachGaussian = std::function<void(const std::function<void(const Gaussian&)>&)>;

struct GaussianFile {
    std::uint64_t count = 0;
    Vec3d up = Vec3d::Zero(); ///< by the convention of the format
    std::string lost;         ///< further properties that discs cannot represent, for the note, or ""
};

/// Reads a file of Gaussians as one scan: a disc for each that is opaque enough, with attribute "opacity". Adds a note
/// about what was dropped and lost. Throws Error if nothing is left.
void readGaussians(const InputFile& input, const GaussianFile& file, const EachGaussian& each, Sink& sink);

} // namespace pointrt
