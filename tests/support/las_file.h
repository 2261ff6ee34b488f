// SPDX-License-Identifier: Apache-2.0
// LAS files assembled byte by byte from the specification.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace pointrt::test {

template <typename Number>
void put(std::string& bytes, std::size_t at, Number number) {
    if (bytes.size() < at + sizeof number) bytes.resize(at + sizeof number);
    std::memcpy(bytes.data() + at, &number, sizeof number);
}

/// A variable length record before the points, or after them.
inline std::string lasRecord(const std::string& user, std::uint16_t id, const std::string& data,
                             bool extended = false) {
    std::string bytes(extended ? 60 : 54, '\0');
    bytes.replace(2, user.size(), user);
    put(bytes, 18, id);
    if (extended)
        put(bytes, 20, std::uint64_t{data.size()});
    else
        put(bytes, 20, static_cast<std::uint16_t>(data.size()));
    return bytes + data;
}

/// An entry of the extra bytes record. options: for type 0 the number of bytes; otherwise flags, 8: scale, 16: offset
inline std::string extraBytes(std::uint8_t type, const std::string& name, std::uint8_t options = 0, double scale = 0,
                              double offset = 0) {
    std::string bytes(192, '\0');
    put(bytes, 2, type);
    put(bytes, 3, options);
    bytes.replace(4, name.size(), name);
    for (std::size_t i = 0; i < 3; ++i) {
        put(bytes, 112 + 8 * i, scale);
        put(bytes, 136 + 8 * i, offset);
    }
    return bytes;
}

struct LasParts {
    std::uint8_t minor = 2, format = 0;
    std::vector<std::string> points; ///< their records, of equal length
    std::vector<std::string> records, extended_records;
    double scale = 0.01;
    double offset[3] = {0, 0, 0};
    bool packed = false;

    std::size_t headerBytes() const { return minor == 4 ? 375 : minor == 3 ? 235 : 227; }

    std::string bytes() const {
        std::string header(headerBytes(), '\0'), body, tail;
        for (const std::string& record : records) body += record;
        const std::size_t point_offset = header.size() + body.size();
        for (const std::string& point : points) body += point;
        for (const std::string& record : extended_records) tail += record;
        header.replace(0, 4, "LASF");
        put(header, 24, std::uint8_t{1});
        put(header, 25, minor);
        put(header, 94, static_cast<std::uint16_t>(header.size()));
        put(header, 96, static_cast<std::uint32_t>(point_offset));
        put(header, 100, static_cast<std::uint32_t>(records.size()));
        put(header, 104, static_cast<std::uint8_t>(format | (packed ? 0x80 : 0)));
        put(header, 105, static_cast<std::uint16_t>(points.empty() ? 20 : points[0].size()));
        put(header, 107, static_cast<std::uint32_t>(points.size()));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            put(header, 131 + 8 * axis, scale);
            put(header, 155 + 8 * axis, offset[axis]);
        }
        if (minor == 4) {
            put(header, 235, std::uint64_t{extended_records.empty() ? 0 : header.size() + body.size()});
            put(header, 243, static_cast<std::uint32_t>(extended_records.size()));
            put(header, 247, std::uint64_t{points.size()});
        }
        return header + body + tail;
    }
};

/// A point of any format, whose bytes after x, y, z are start, start + 1 and so on.
inline std::string lasPoint(std::size_t bytes, std::int32_t x, std::int32_t y, std::int32_t z, std::uint8_t start) {
    std::string point(bytes, '\0');
    put(point, 0, x);
    put(point, 4, y);
    put(point, 8, z);
    for (std::size_t i = 12; i < bytes; ++i) point[i] = static_cast<char>(start + (i - 12));
    return point;
}

} // namespace pointrt::test
