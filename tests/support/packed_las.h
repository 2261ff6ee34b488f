// SPDX-License-Identifier: Apache-2.0
// LAS and LAZ files in memory, made by our writer.
#pragma once

#include "format/pointio/las_writer.h"

namespace pointrt::test {

/// points: their records, of equal length. change: edits the other fields
inline std::string writeLas(std::uint8_t point_format, const std::vector<std::string>& points, bool packed,
                            const std::function<void(LasDescription&)>& change = {}) {
    LasDescription description;
    LasHeader& header = description.header;
    header.version_minor = point_format < 6 ? 2 : 4;
    header.point_format = point_format;
    header.packed = packed;
    header.point_count = points.size();
    header.record_bytes = points.empty() ? lasRecordBytes(point_format) : static_cast<std::uint16_t>(points[0].size());
    header.scale = {0.01, 0.01, 0.01};
    if (change) change(description);
    std::string bytes;
    LasWriter writer(description, {[&](const void* data, std::size_t size) {
                                       bytes.append(static_cast<const char*>(data), size);
                                       return true;
                                   },
                                   [&](std::uint64_t offset, const void* data, std::size_t size) {
                                       bytes.replace(offset, size, static_cast<const char*>(data), size);
                                       return true;
                                   }});
    for (const std::string& point : points) writer.add(point.data(), 1);
    writer.finish();
    return bytes;
}

} // namespace pointrt::test
