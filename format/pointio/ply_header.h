// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file, for reading its vertices.
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
    std::uint32_t type = 0; ///< PRO_TYPE_* except 64-bit integers
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::kText;
    std::uint64_t vertices = 0;
    std::vector<PlyProperty> properties; ///< of a vertex, with unique names that include x, y and z
    std::size_t bytes = 0, lines = 0;    ///< of the header

    std::size_t rowBytes() const; ///< bytes of a binary vertex
};

/// Ignores elements after the vertices, and unknown lines, which some Stanford scans have. Throws Error kBadInput
/// "PATH[:LINE]: reason" for malformed headers, vertices without x, y and z, with lists or after other elements, and
/// for more vertices than the file has room for.
/// @param path for messages
PlyHeader readPlyHeader(const std::string& path, std::string_view file);

} // namespace pointrt::format
