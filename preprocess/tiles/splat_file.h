// SPDX-License-Identifier: GPL-3.0-or-later
// A tile's splats on disk between the steps of a bake: L-X-Y-Z.splats. Numbers as this machine has them, little-endian.
#pragma once

#include <string>

#include "format/base/mapped_file.h"
#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// What the file says before its arrays.
struct SplatFileHead {
    char magic[8] = {};
    std::uint64_t checksum = 0; ///< XXH3 of all bytes behind it
    std::uint32_t level = 0;
    TileCell cell{};
    std::uint64_t count = 0;
    std::uint32_t has_colors = 0, has_noise = 0;
    float radius_min = 0, radius_max = 0; ///< input units; 0 where there are no splats
    PositionCode lowest{}, highest{};     ///< of the positions, on each axis
    double error = 0, spacing = 0;
    float noise = 0; ///< median, input units
    std::uint32_t attribute_count = 0;
};

/// What a file says without its arrays.
struct SplatFileSummary {
    SplatFileHead head;
    std::vector<SetAttribute> attributes; ///< with the ranges of this tile
};

/// FOLDER/L-X-Y-Z.splats.
std::string splatFileOf(const std::string& folder, const TileKey& tile);

/// Writes the file, which appears whole. The same splats give the same bytes. Throws Error (kCannotWrite).
void writeSplats(const std::string& folder, const TileKey& tile, const TileSplats& splats);

/// A file mapped and checked: its size, its checksum, that it is of this tile.
class SplatFile {
public:
    /// @param widest of original splats' radii, input units: SplatsView::widest. Throws Error (kBadInput).
    SplatFile(const std::string& folder, const TileKey& tile, float widest = std::numeric_limits<float>::infinity());

    const SplatFileHead& head() const { return head_; }
    /// Points into the file.
    const SplatsView& splats() const { return view_; }
    /// The schema of its attributes, without values.
    const std::vector<Attribute>& schema() const { return schema_; }

private:
    void take(const TileKey& tile);

    std::string path_;
    format::MappedFile file_;
    SplatFileHead head_;
    std::vector<Attribute> schema_;
    SplatsView view_;
};

/// Gives back the disk that a file's arrays take; its summary can still be read. Throws Error (kBadInput,
/// kCannotWrite).
void dropArrays(const std::string& folder, const TileKey& tile);

/// All of it in memory. Throws Error (kBadInput).
TileSplats readSplats(const std::string& folder, const TileKey& tile);

/// As in the file, which is not held against its checksum. Throws Error (kBadInput).
std::vector<float> readRadii(const std::string& folder, const TileKey& tile);

/// Whether the file is there, whole, and of this tile.
bool hasSplatFile(const std::string& folder, const TileKey& tile);

/// Without looking at the arrays. Throws Error (kBadInput).
SplatFileSummary readSplatSummary(const std::string& folder, const TileKey& tile);

} // namespace pointrt
