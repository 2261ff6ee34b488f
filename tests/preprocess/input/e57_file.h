// SPDX-License-Identifier: Apache-2.0
// Small E57 files for tests, right or wrong in any place.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointrt::test {

/// A column of a scan's points.
struct E57TestColumn {
    std::string tag;                   ///< "cartesianX"
    std::string type;                  ///< attributes of the tag
    int bits = 64;                     ///< of each value
    std::vector<std::uint64_t> values; ///< as stored
};

E57TestColumn e57Doubles(const std::string& tag, const std::vector<double>& values);
E57TestColumn e57Floats(const std::string& tag, const std::vector<float>& values);
/// Of the bits that least and most need.
E57TestColumn e57Whole(const std::string& tag, std::int64_t least, std::int64_t most,
                       const std::vector<std::int64_t>& values);
/// As that, of values offset + scale * number.
E57TestColumn e57Scaled(const std::string& tag, std::int64_t least, std::int64_t most, double scale, double offset,
                        const std::vector<std::int64_t>& values);

struct E57TestScan {
    std::vector<E57TestColumn> columns;
    std::string xml = "";         ///< beside its points: name, pose, limits
    std::string points = "";      ///< promised; as many as the first column has where ""
    std::size_t packets = 1;      ///< that each column's bytes are cut into
    bool other_packets = false;   ///< an index packet and one to be ignored between them
    std::string file_offset = ""; ///< of its section; where that is where ""
};

/// The logical bytes of a file: without checksums.
std::string e57Logical(const std::vector<E57TestScan>& scans, const std::string& root_xml = "");

/// Logical bytes in pages of 1024, each with its CRC-32C; what is missing of the last is filled with zeros.
std::string e57Pages(std::string logical);

std::string e57File(const std::vector<E57TestScan>& scans, const std::string& root_xml = "");

/// <name type="String">text</name>
std::string e57Text(const std::string& name, const std::string& text);
std::string e57Number(const std::string& name, double value);

} // namespace pointrt::test
