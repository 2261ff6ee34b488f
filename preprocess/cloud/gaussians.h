// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussians of a radiance field as attributes of a cloud, so that filters, reordering and tiles carry them.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// The names of Gaussians' attributes, all 32-bit floats. This one: peak opacity, 0 to 1.
inline constexpr const char* kGaussianOpacity = "opacity";
/// Standard deviations along the Gaussian's three axes, input units, all above 0.
inline constexpr const char* kGaussianDeviation = "gaussian_deviation";
/// Unit quaternion w x y z that turns the coordinate axes into the Gaussian's.
inline constexpr const char* kGaussianRotation = "gaussian_rotation";
/// View-independent colour: red, green, blue, display-encoded, not clamped.
inline constexpr const char* kGaussianColor = "gaussian_color";
/// Followed by a number from 1: factors of that spherical harmonic in red, green and blue (gaussianHarmonics).
inline constexpr std::string_view kGaussianHarmonicPrefix = "gaussian_harmonic_";

/// Most harmonics of a Gaussian besides the constant one: those of degrees 1 to 3.
inline constexpr int kMostGaussianHarmonics = 15;

/// The number of harmonics up to a degree, without the constant one: 0, 3, 8 or 15.
constexpr int gaussianHarmonicCount(int degree) { return (degree + 1) * (degree + 1) - 1; }

/// The attribute of a harmonic. number: from 1
inline std::string gaussianHarmonicName(int number) {
    return std::string(kGaussianHarmonicPrefix) + std::to_string(number);
}

inline bool isGaussianHarmonic(std::string_view name) { return name.starts_with(kGaussianHarmonicPrefix); }

/// Whether an attribute of a cloud of Gaussians is part of them.
inline bool isGaussianAttribute(std::string_view name) {
    return name == kGaussianOpacity || name == kGaussianDeviation || name == kGaussianRotation ||
           name == kGaussianColor || isGaussianHarmonic(name);
}

/// The values of a cloud's Gaussians, one, three or four for each point; see the names above.
struct GaussianColumns {
    const float* opacity = nullptr; ///< NaN for points that are not Gaussians
    const float* deviation = nullptr;
    const float* rotation = nullptr;
    const float* color = nullptr;
    std::array<const float*, kMostGaussianHarmonics> harmonics{}; ///< those of `degree`; 0 if a file had fewer
    int degree = 0;                                               ///< of the harmonics, 0 to 3
};

/// The values of an attribute of 32-bit floats; null if the cloud has none with this name and number of components.
inline const float* floatAttribute(const Cloud& cloud, std::string_view name, std::uint32_t components) {
    const auto found = std::find_if(cloud.attributes.begin(), cloud.attributes.end(),
                                    [&](const Attribute& each) { return each.name == name; });
    const bool fits = found != cloud.attributes.end() && found->type == Scalar::kF32 &&
                      found->components == components &&
                      found->values.size() == cloud.positions.size() * found->bytesEach();
    return fits ? reinterpret_cast<const float*>(found->values.data()) : nullptr;
}

/// The Gaussians of a cloud, valid until its attributes change; nullopt if it has none.
inline std::optional<GaussianColumns> gaussianColumns(const Cloud& cloud) {
    GaussianColumns columns;
    columns.opacity = floatAttribute(cloud, kGaussianOpacity, 1);
    columns.deviation = floatAttribute(cloud, kGaussianDeviation, 3);
    columns.rotation = floatAttribute(cloud, kGaussianRotation, 4);
    columns.color = floatAttribute(cloud, kGaussianColor, 3);
    if (!columns.opacity || !columns.deviation || !columns.rotation || !columns.color) return std::nullopt;
    int count = 0;
    for (; count < kMostGaussianHarmonics; ++count) {
        const float* const values = floatAttribute(cloud, gaussianHarmonicName(count + 1), 3);
        if (!values) break;
        columns.harmonics[static_cast<std::size_t>(count)] = values;
    }
    while (columns.degree < 3 && gaussianHarmonicCount(columns.degree + 1) <= count) ++columns.degree;
    return columns;
}

/// The real spherical harmonics of degrees 1 to `degree` in a direction of unit length, in the order and with the signs
/// of the code of "3D Gaussian Splatting for Real-Time Radiance Field Rendering" (Kerbl et al. 2023); 0 for higher
/// degrees. A Gaussian's colour seen along the direction is its gaussian_color plus the sum of each times its
/// gaussian_harmonic.
inline std::array<double, kMostGaussianHarmonics> gaussianHarmonics(const Vec3d& direction, int degree) {
    std::array<double, kMostGaussianHarmonics> values{};
    const double x = direction.x(), y = direction.y(), z = direction.z();
    const double xx = x * x, yy = y * y, zz = z * z;
    if (degree >= 1) {
        constexpr double kFirst = 0.4886025119029199; // sqrt(3 / (4 pi))
        values[0] = -kFirst * y;
        values[1] = kFirst * z;
        values[2] = -kFirst * x;
    }
    if (degree >= 2) {
        // sqrt(15 / (4 pi)), sqrt(5 / (16 pi)), sqrt(15 / (16 pi))
        constexpr double kMixed = 1.0925484305920792, kAxial = 0.31539156525252005, kSquares = 0.5462742152960396;
        values[3] = kMixed * x * y;
        values[4] = -kMixed * y * z;
        values[5] = kAxial * (2 * zz - xx - yy);
        values[6] = -kMixed * x * z;
        values[7] = kSquares * (xx - yy);
    }
    if (degree >= 3) {
        // sqrt(35 / (32 pi)), sqrt(105 / (4 pi)), sqrt(21 / (32 pi)), sqrt(7 / (16 pi)), sqrt(105 / (16 pi))
        constexpr double kCubes = 0.5900435899266435, kProduct = 2.890611442640554, kSlanted = 0.4570457994644658,
                         kPolar = 0.3731763325901154, kWaist = 1.445305721320277;
        values[8] = -kCubes * y * (3 * xx - yy);
        values[9] = kProduct * x * y * z;
        values[10] = -kSlanted * y * (4 * zz - xx - yy);
        values[11] = kPolar * z * (2 * zz - 3 * xx - 3 * yy);
        values[12] = -kSlanted * x * (4 * zz - xx - yy);
        values[13] = kWaist * z * (xx - yy);
        values[14] = -kCubes * x * (xx - 3 * yy);
    }
    return values;
}

} // namespace pointrt
