// SPDX-License-Identifier: Apache-2.0
// The compressed points of LAZ files, which come in chunks.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "format/pointio/las.h"

struct scan_laz_reader;

namespace pointrt {

/// Whether this build reads and writes LAZ (POINTRT_LAZ_E57). If not, everything else here throws Error (kCannotRun)
/// that says what to install.
bool hasLaz();

/// Points that are compressed independently of others.
struct LazChunk {
    std::uint64_t at = 0, bytes = 0; ///< in the file
    std::uint64_t points = 0;
};

struct LazLayout {
    std::string_view record; ///< payload of the LASzip VLR
    std::size_t record_bytes = 0;
    bool layered =
        false; ///< each attribute of a chunk is compressed separately; the chunk starts with its number of points
    /// All chunks, in the order of their points.
    std::vector<LazChunk> chunks;
    /// There is no chunk table: chunks has a single entry, for a run of chunks to the end of the file, whose sizes are
    /// found by reading.
    bool in_one_run = false;
    std::uint64_t run_points = 0; ///< in each chunk of the run; 0: stated in the chunk
};

/// Locates the chunks. Throws Error (kBadInput, without the file's name) if the compression is missing or unknown, the
/// chunk table is invalid, or the file announces more points than its bytes can hold.
/// @param salvages accept a chunk table with fewer points than announced
LazLayout lazLayout(const LasFile& file, bool salvages = false);

/// Decompresses points in sequence.
class LazStream {
public:
    /// layout and file must outlive the stream.
    LazStream(const LazLayout& layout, std::string_view file, const LazChunk& chunk);
    ~LazStream();
    LazStream(const LazStream&) = delete;
    LazStream& operator=(const LazStream&) = delete;

    /// Reads the next count points as LAS records. Throws Error (kBadInput) if the data is malformed.
    void read(char* records, std::size_t count);

private:
    void openNext();

    const LazLayout& layout_;
    std::string_view rest_; ///< from the start of the current chunk
    scan_laz_reader* reader_ = nullptr;
    std::uint64_t chunk_points_;
    std::uint64_t left_in_chunk_ = 0;
};

/// The payload of a LASzip VLR.
std::string lazRecord(std::uint8_t point_format, std::uint16_t extra_bytes, std::uint32_t chunk_points);
/// Compresses the point records of a chunk.
std::string packChunk(std::string_view laz_record, std::string_view records);
/// The chunk table.
std::string packTable(std::string_view laz_record, const std::vector<std::uint64_t>& chunk_points,
                      const std::vector<std::uint64_t>& chunk_bytes);

} // namespace pointrt
