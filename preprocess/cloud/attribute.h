// SPDX-License-Identifier: GPL-3.0-or-later
// What a scan says of each point besides position, normal and colour.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/cloud/scalar.h"

namespace pointrt {

/// A named array of numbers, the same bytes as in memory of their type.
struct Attribute {
    std::string name; ///< those of laspy where the thing is one of LAS: format/SPEC.md lists them
    Scalar type = Scalar::kF32;
    std::uint32_t components = 1;
    std::vector<char> values; ///< bytesEach() a point

    std::size_t bytesEach() const { return scalarSize(type) * components; }
};

/// 16-bit red, green and blue of a point, three components.
inline constexpr const char* kRgb16 = "rgb16";
/// The number of the scan that a point is of, where there are several.
inline constexpr const char* kScanNumber = "scan";
/// Classes of the ASPRS.
inline constexpr const char* kClassification = "classification";

} // namespace pointrt
