// SPDX-License-Identifier: Apache-2.0
// The light that a ray sees of translucent Gaussians, by brute force over all of them in double precision: the
// reference for the ray tracer. Moenne-Loccoz et al., 3D Gaussian Ray Tracing, 2024; colours as in Kerbl et al., 3D
// Gaussian Splatting for Real-Time Radiance Field Rendering, 2023. Shares no code with the tracer.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tests/gaussians/double3.h"

namespace pointrt::test {

/// A Gaussian with a lower opacity along a ray does not count; no opacity exceeds the other constant.
constexpr double kOracleAlphaMin = 1.0 / 255, kOracleAlphaMax = 0.99;

/// The usual transmittance below which a ray ends.
constexpr double kOracleStop = 1e-4;
constexpr double kNeverStop = 0;

constexpr std::uint32_t kNoGaussian = 0xFFFFFFFF;

struct OracleGaussian {
    Double3 mean{};
    Double3 deviation{1, 1, 1};                 ///< standard deviations along its axes, above 0
    std::array<double, 4> rotation{1, 0, 0, 0}; ///< of its axes: w x y z, any length but 0
    double opacity = 0;                         ///< at the mean, 0 to 1
    Double3 color{};                            ///< display-encoded: 0.5 + the constant harmonic * its coefficient
    std::vector<Double3> harmonics;             ///< red, green, blue of each further coefficient: 0, 3, 8 or 15

    int degree() const; ///< of the harmonics, 0 to 3
};

/// t is in lengths of the direction, which is a unit vector.
struct OracleRay {
    Double3 origin{}, direction{0, 0, 1};
    double t_max = std::numeric_limits<double>::infinity();
};

/// x -> rows * (x - mean) makes a Gaussian the normal distribution of deviation 1.
struct OracleTransform {
    Double3 mean{};
    std::array<Double3, 3> rows{};
    double opacity = 0;
    double reach_squared = 0; ///< squared deviations from the mean beyond which it does not count; negative: nowhere
};

struct OracleScene {
    std::vector<OracleGaussian> gaussians;
    std::vector<OracleTransform> transforms; ///< one for each Gaussian
};

/// Throws std::invalid_argument if a Gaussian has no shape: a deviation or a rotation of 0, numbers that are not
/// finite.
OracleScene oracleScene(std::vector<OracleGaussian> gaussians);

/// Where a Gaussian is most opaque along the line of a ray.
struct OraclePeak {
    double t = 0, alpha = 0; ///< alpha is at most kOracleAlphaMax, and 0 where it is far below kOracleAlphaMin
};
OraclePeak peakAlong(const OracleTransform& transform, const OracleRay& ray);

struct OracleHit {
    double t = 0, alpha = 0;
    std::uint32_t index = kNoGaussian;
    bool operator==(const OracleHit&) const = default;
};

/// All Gaussians that count along a ray, 0 < t < t_max, in the order of t, and of their indices where t is equal.
std::vector<OracleHit> hitsAlong(const OracleScene& scene, const OracleRay& ray);
/// The same among some of them, which must be in ascending order.
std::vector<OracleHit> hitsAlong(const OracleScene& scene, const OracleRay& ray,
                                 std::span<const std::uint32_t> candidates);

/// The real spherical harmonics of degree 0 to 3 in the order and with the signs of Kerbl et al.
std::array<double, 16> harmonicBasis(const Double3& direction);

/// Display-encoded colour along a ray of this basis, at least 0.
Double3 colorAlong(const OracleGaussian& gaussian, const std::array<double, 16>& basis);

struct OracleComposite {
    Double3 radiance{};                                     ///< display-encoded
    double transmittance = 1;                               ///< for what lies behind
    double depth = std::numeric_limits<double>::infinity(); ///< t of the hit after which at most half passes
    std::uint32_t strongest = kNoGaussian;                  ///< of the largest weight; the first of equal ones
    double strongest_weight = 0;                            ///< transmittance before it * its alpha
    std::uint32_t counted = 0;                              ///< Gaussians composited
    bool operator==(const OracleComposite&) const = default;
};

/// Composites sorted hits front to back. The Gaussian that lowers the transmittance below stop_below still counts, the
/// next one does not; kNeverStop: all count.
OracleComposite composite(const OracleScene& scene, const OracleRay& ray, std::span<const OracleHit> hits,
                          double stop_below = kOracleStop);

} // namespace pointrt::test
