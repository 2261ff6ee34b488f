// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a tile's splats between the steps of a bake: L-X-Y-Z.splats, little-endian.
#pragma once

#include <string>

#include "format/os/mapped_file.h"
#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// Header of the file.
struct SplatFileHead {
    char magic[8] = {};
    std::uint64_t checksum = 0; ///< XXH3 of all bytes after it
    std::uint32_t level = 0;
    TileCell cell{};
    std::uint64_t count = 0;
    std::uint32_t has_colors = 0, has_noise = 0;
    float radius_min = 0, radius_max = 0; ///< input units; 0 without splats
    PositionCode lowest{}, highest{};     ///< of the positions, per axis
    double error = 0, spacing = 0;
    float noise = 0; ///< median, input units
    std::uint32_t attribute_count = 0;
};

/// A file without its arrays.
struct SplatFileSummary {
    SplatFileHead head;
    std::vector<SetAttribute> attributes; ///< with the ranges of this tile
};

/// Returns FOLDER/L-X-Y-Z.splats.
std::string splatFileOf(const std::string& folder, const TileKey& tile);

/// Writes the file atomically. The same splats give the same bytes. Throws Error (kCannotWrite).
void writeSplats(const std::string& folder, const TileKey& tile, const TileSplats& splats);

/// A memory-mapped file, whose size, checksum and tile have been checked.
class SplatFile {
public:
    /// @param widest largest radius of original splats, input units: SplatsView::widest. Throws Error (kBadInput).
    SplatFile(const std::string& folder, const TileKey& tile, float widest = std::numeric_limits<float>::infinity());

    const SplatFileHead& head() const { return head_; }
    /// Points into the file.
    const SplatsView& splats() const { return view_; }
    /// The schema of its attributes, without values.
    const std::vector<Attribute>& schema() const { return schema_; }

private:
    void parse(const TileKey& tile);

    std::string path_;
    format::MappedFile file_;
    SplatFileHead head_;
    std::vector<Attribute> schema_;
    SplatsView view_;
};

/// Truncates a file to its summary, which can still be read. Throws Error (kBadInput, kCannotWrite).
void dropArrays(const std::string& folder, const TileKey& tile);

/// Reads the file into memory. Throws Error (kBadInput).
TileSplats readSplats(const std::string& folder, const TileKey& tile);

/// Reads radii without checking the checksum. Throws Error (kBadInput).
std::vector<float> readRadii(const std::string& folder, const TileKey& tile);

/// Whether the file exists, is complete and belongs to this tile.
bool hasSplatFile(const std::string& folder, const TileKey& tile);

/// Reads the summary only. Throws Error (kBadInput).
SplatFileSummary readSplatSummary(const std::string& folder, const TileKey& tile);

} // namespace pointrt
