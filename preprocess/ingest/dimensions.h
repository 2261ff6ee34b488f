// SPDX-License-Identifier: GPL-3.0-or-later
// Meaning of the columns of a scan.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace pointrt {

enum Dimension {
    kX,
    kY,
    kZ,
    kNormalX,
    kNormalY,
    kNormalZ,
    kRed,
    kGreen,
    kBlue,
    kRadius, ///< of a disc: set by readers of splats, never by name
    kDimensionCount,
    kIgnored = kDimensionCount
};

/// One vertex: a value per dimension, and one for ignored columns.
using Row = std::array<double, kDimensionCount + 1>;

/// Sets the colours from bytes of an integer: blue is the lowest, then green and red.
inline void setPackedColor(Row& row, std::uint32_t rgb) {
    row[kRed] = rgb >> 16 & 255;
    row[kGreen] = rgb >> 8 & 255;
    row[kBlue] = rgb & 255;
}

/// The dimension of a property, field or column name, ignoring case; kIgnored if it has none.
Dimension dimensionOfName(std::string_view name);

/// Keeps the first column of each dimension; ignores later ones and incomplete normals and colours.
void resolveDimensions(std::span<Dimension> dimensions);

bool hasPositions(std::span<const Dimension> dimensions);
bool hasNormals(std::span<const Dimension> dimensions);
bool hasColors(std::span<const Dimension> dimensions);

} // namespace pointrt
