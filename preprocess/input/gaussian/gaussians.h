// SPDX-License-Identifier: GPL-3.0-or-later
// Passes Gaussians of a radiance field, from any format that holds them, to the sink.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "preprocess/cloud/gaussians.h"
#include "preprocess/ingest/sink.h"

namespace pointrt {

/// One Gaussian.
struct Gaussian {
    Vec3d position = Vec3d::Zero();
    Vec3f deviations = Vec3f::Zero(); ///< along its axes; 0 along the third axis of 2D Gaussians
    Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity(); ///< of its axes, any length
    float opacity = 1;                                            ///< at its centre, 0 to 1
    Vec3f color = Vec3f::Zero(); ///< display-encoded, not clamped: the view-independent part
    /// Factors of gaussianHarmonics in red, green and blue; those of GaussianFile::degree are used.
    std::array<Vec3f, kMostGaussianHarmonics> harmonics = zeroHarmonics();

    static std::array<Vec3f, kMostGaussianHarmonics> zeroHarmonics() {
        std::array<Vec3f, kMostGaussianHarmonics> zero;
        zero.fill(Vec3f::Zero());
        return zero;
    }
};

/// The constant term of the real spherical harmonics, 1 / (2 sqrt(pi)): colours are stored as its multiples around
/// grey.
inline constexpr double kConstantHarmonic = 0.28209479177387814;

/// The colour of a stored factor of the constant harmonic.
inline float colorOfHarmonic(double factor) { return static_cast<float>(0.5 + kConstantHarmonic * factor); }

inline float sigmoid(float value) { return 1 / (1 + std::exp(-value)); }

/// Calls its argument with each Gaussian of a file, in order; may be called repeatedly.
using EachGaussian = std::function<void(const std::function<void(const Gaussian&)>&)>;

struct GaussianFile {
    std::uint64_t count = 0;
    Vec3d up = Vec3d::Zero(); ///< by the convention of the format
    int degree = 0;           ///< of the harmonics, 0 to 3
};

/// Reads a file of Gaussians as one scan. Keeps them as they are, as the attributes of preprocess/cloud/gaussians.h,
/// with a normal, a radius and a colour for programs that show discs; drops those that are not finite or have no
/// rotation or no extent. If sink.gaussians_as_discs, makes an opaque disc of each that is opaque enough. Adds a note
/// about what was read and dropped. Throws Error if nothing is left, or if the sink's transform mirrors or skews.
void readGaussians(const InputFile& input, const GaussianFile& file, const EachGaussian& each, Sink& sink);

/// Adds a note that harmonics of degree 4, which some programs train, are left out.
void noteHigherHarmonics(const InputFile& input, Sink& sink);

/// As readGaussians, without setting the world frame: for files with several scans, or a frame that they state.
/// @param title of the scan within the file, or ""
void readGaussianScan(const InputFile& input, const GaussianFile& file, const EachGaussian& each, Sink& sink,
                      const std::string& title = "");

} // namespace pointrt
