// SPDX-License-Identifier: Apache-2.0
// Writes small E57 files for tests, valid or invalid in any field.
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
/// Attributes of an integer column with the bits that minimum and maximum need.
E57TestColumn e57Whole(const std::string& tag, std::int64_t least, std::int64_t most,
                       const std::vector<std::int64_t>& values);
/// The same for scaled integers: offset + scale * number.
E57TestColumn e57Scaled(const std::string& tag, std::int64_t least, std::int64_t most, double scale, double offset,
                        const std::vector<std::int64_t>& values);

struct E57TestScan {
    std::vector<E57TestColumn> columns;
    std::string xml = "";         ///< further elements: name, pose, limits
    std::string points = "";      ///< declared count; "": the length of the first column
    std::size_t packets = 1;      ///< number of packets per column
    bool other_packets = false;   ///< insert an index packet and an ignored packet
    std::string file_offset = ""; ///< declared offset of its section; "": the true one
};

/// The logical bytes of a file, without checksums.
std::string e57Logical(const std::vector<E57TestScan>& scans, const std::string& root_xml = "");

/// Splits logical bytes into pages of 1024 with CRC-32C; pads the last with zeros.
std::string e57Pages(std::string logical);

std::string e57File(const std::vector<E57TestScan>& scans, const std::string& root_xml = "");

/// <name type="String">text</name>
std::string e57Text(const std::string& name, const std::string& text);
std::string e57Number(const std::string& name, double value);

} // namespace pointrt::test
