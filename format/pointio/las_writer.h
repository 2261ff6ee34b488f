// SPDX-License-Identifier: Apache-2.0
// LAS and LAZ files, written.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "format/pointio/las_source_header.h"

namespace pointrt {

/// Where a file's bytes go. Each returns false where it cannot.
struct LasTarget {
    std::function<bool(const void* data, std::size_t bytes)> write;
    /// In place of bytes that were written before.
    std::function<bool(std::uint64_t offset, const void* data, std::size_t bytes)> overwrite;
};

/// What a file says beside its points.
struct LasDescription {
    LasHeader header;                       ///< version, point format, record_bytes, packed, scale and offset
    std::string header_bytes;               ///< of the file that it came from, whose other fields are taken over; or ""
    std::vector<LasSource::Record> records; ///< with those of the extra bytes, without those of LAZ
};

/// Writes the header, its records and the points, in order. Records of points are in memory a few chunks at a time.
class LasWriter {
public:
    /// Throws Error (kCannotRun) for a packed file in a build without Rust.
    LasWriter(const LasDescription& description, LasTarget target);

    /// Points as records; more than 2^32 - 1 in all want version 1.4. False where they cannot be written.
    bool add(const char* records, std::size_t count);
    /// The rest: what the points make of the header, chunk table, records behind the points.
    bool finish();

private:
    bool put(const void* data, std::size_t bytes);
    bool begin();
    bool packFull(bool last);
    void countPoint(const char* record);
    bool putRecord(const LasSource::Record& record);
    std::string headerBytes() const;

    LasDescription description_;
    LasTarget target_;
    std::string laszip_; ///< payload of the record of LAZ
    std::uint64_t at_ = 0, count_ = 0;
    std::uint32_t point_offset_ = 0;
    std::uint64_t evlr_offset_ = 0;
    std::array<std::uint64_t, 15> returns_{}; ///< points of each return number
    std::array<std::int32_t, 3> low_, high_;
    std::vector<char> waiting_; ///< records that fill no chunk yet
    std::vector<std::uint64_t> chunk_points_, chunk_bytes_;
};

} // namespace pointrt
