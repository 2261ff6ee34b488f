// SPDX-License-Identifier: Apache-2.0
// The packed points of LAZ files: where their chunks are, and what is in them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "format/pointio/las.h"

struct scan_laz_reader;

namespace pointrt {

/// Whether this build has what packs and unpacks points: POINTRT_LAZ_E57. Where not, all else here throws
/// Error (kCannotRun) that says what to install.
bool hasLaz();

/// Points that are packed together and know nothing of those before.
struct LazChunk {
    std::uint64_t at = 0, bytes = 0; ///< in the file
    std::uint64_t points = 0;
};

struct LazLayout {
    std::string_view record; ///< payload of the LASzip VLR
    std::size_t record_bytes = 0;
    bool layered = false; ///< each attribute of a chunk by itself; its start says how many points it has
    /// In the order of the points, all of which they hold.
    std::vector<LazChunk> chunks;
    /// The one entry above is a run of chunks up to the end of the file: only reading them tells their sizes.
    bool in_one_run = false;
    std::uint64_t run_points = 0; ///< in each of a run's chunks; 0: they say so
};

/// Finds the chunks. Throws Error (kBadInput, without the file's name) where the file says nothing that makes sense of
/// how its points are packed, or promises more points than so many bytes can stand for.
LazLayout lazLayout(const LasFile& file);

/// Unpacks points one after the other.
class LazStream {
public:
    /// The bytes that the layout and the chunk lie in must live as long.
    LazStream(const LazLayout& layout, std::string_view file, const LazChunk& chunk);
    ~LazStream();
    LazStream(const LazStream&) = delete;
    LazStream& operator=(const LazStream&) = delete;

    /// The next points, count of them, as records of a LAS file. Throws Error (kBadInput) where they are broken.
    void read(char* records, std::size_t count);

private:
    void openNext();

    const LazLayout& layout_;
    std::string_view rest_; ///< from the chunk that is read on
    scan_laz_reader* reader_ = nullptr;
    std::uint64_t chunk_points_;
    std::uint64_t left_in_chunk_ = 0;
};

/// Payload of the LASzip VLR of a file in chunks of so many points.
std::string lazRecord(std::uint8_t point_format, std::uint16_t extra_bytes, std::uint32_t chunk_points);
/// One chunk, from its points' records.
std::string packChunk(std::string_view laz_record, std::string_view records);
/// The table of all, from points and bytes of each.
std::string packTable(std::string_view laz_record, const std::vector<std::uint64_t>& chunk_points,
                      const std::vector<std::uint64_t>& chunk_bytes);

} // namespace pointrt
