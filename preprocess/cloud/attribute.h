// SPDX-License-Identifier: GPL-3.0-or-later
// Extra per-point attributes besides position, normal and colour.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/cloud/scalar.h"

namespace pointrt {

/// A named array of numbers in memory layout.
struct Attribute {
    std::string name; ///< format/SPEC.md lists those with a meaning (for LAS, the names of laspy)
    Scalar type = Scalar::kF32;
    std::uint32_t components = 1;
    std::vector<char> values; ///< bytesEach() per point

    std::size_t bytesEach() const { return scalarSize(type) * components; }
};

/// 16-bit red, green and blue of a point, three components.
inline constexpr const char* kRgb16 = "rgb16";
/// The index of the scan of a point, if there are several.
inline constexpr const char* kScanNumber = "scan";
/// ASPRS classes.
inline constexpr const char* kClassification = "classification";

} // namespace pointrt
