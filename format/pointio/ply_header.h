// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file whose vertices are to be read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt::format {

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };

struct PlyProperty {
    std::string name;
    std::uint32_t type = 0; ///< PRO_TYPE_*, none of 64-bit integers
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::kText;
    std::uint64_t vertices = 0;
    std::vector<PlyProperty> properties; ///< of a vertex, each of another name, x, y and z among them
    std::size_t bytes = 0, lines = 0;    ///< of the header

    std::size_t rowBytes() const; ///< of a vertex, where they are not text
};

/// What follows the vertices is of no account. Lines with words that PLY does not know are skipped: scans of Stanford's
/// have some. Throws Error kBadInput "PATH[:LINE]: reason" for what is no PLY header, for vertices without x, y and z,
/// with lists or behind other elements, and for more of them than there can be in the file.
/// @param path for messages
PlyHeader readPlyHeader(const std::string& path, std::string_view file);

} // namespace pointrt::format
