// SPDX-License-Identifier: Apache-2.0
// Writes LAS and LAZ files.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "format/pointio/las_source_header.h"

namespace pointrt {

/// Receives the bytes of a file. The functions return false on failure.
struct LasTarget {
    std::function<bool(const void* data, std::size_t bytes)> write;
    /// Overwrites bytes written before.
    std::function<bool(std::uint64_t offset, const void* data, std::size_t bytes)> overwrite;
};

/// Header and records of a file.
struct LasDescription {
    LasHeader header;                       ///< version, point format, record_bytes, packed, scale and offset
    std::string header_bytes;               ///< of the source file, for all other fields; or ""
    std::vector<LasSource::Record> records; ///< including extra bytes, without LAZ
};

/// Writes header, records and points, in this order. Holds a few chunks of points in memory.
class LasWriter {
public:
    /// Throws Error (kCannotRun) for a packed file in a build without Rust.
    LasWriter(const LasDescription& description, LasTarget target);

    /// Appends point records; more than 2^32 - 1 in total need version 1.4. False if writing fails.
    bool add(const char* records, std::size_t count);
    /// Writes the last chunk, the chunk table, extended records, and the header's counts and bounds.
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
    std::string laszip_; ///< payload of the LASzip VLR
    std::uint64_t at_ = 0, count_ = 0;
    std::uint32_t point_offset_ = 0;
    std::uint64_t evlr_offset_ = 0;
    std::array<std::uint64_t, 15> returns_{}; ///< points of each return number
    std::array<std::int32_t, 3> low_, high_;
    std::vector<char> pending_; ///< records of the unfinished chunks
    std::vector<std::uint64_t> chunk_points_, chunk_bytes_;
};

} // namespace pointrt
