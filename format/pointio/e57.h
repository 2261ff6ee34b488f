// SPDX-License-Identifier: Apache-2.0
// E57 files (ASTM E2807): scans, and their points as stored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct scan_e57;
struct scan_e57_points;

namespace pointrt {

/// Whether this build reads E57 (POINTRT_LAZ_E57). If not, openE57 throws Error (kCannotRun) that says what to install.
bool hasE57();

/// The numbers of a column: integers, integers with value = offset + scale * integer, float or double.
enum class E57Kind { kWhole, kScaled, kSingle, kDouble };

struct E57Column {
    std::string name; ///< as in the standard, "cartesianX"; "PREFIX:NAME", or "NAME", of an extension
    E57Kind kind = E57Kind::kDouble;
    std::int64_t least = 0, most = 0; ///< of raw integers; the range of 64 bits if not given
    double scale = 1, offset = 0;
};

struct E57Limits {
    double least = 0, most = 0;
};

struct E57Scan {
    std::string name, guid;
    std::uint64_t points = 0; ///< as stated; all scans together fit in the file's bytes
    std::vector<E57Column> columns;
    bool has_pose = false;
    std::array<double, 4> rotation = {1, 0, 0, 0}; ///< w x y z, of any length: file = rotation * scan + translation
    std::array<double, 3> translation = {0, 0, 0}; ///< metres
    std::array<std::optional<E57Limits>, 3> color_limits; ///< of the scan, else of the types of its columns
    std::optional<E57Limits> intensity_limits;
};

struct CloseE57 {
    void operator()(scan_e57* file) const;
    void operator()(scan_e57_points* points) const;
};

struct E57File {
    std::unique_ptr<scan_e57, CloseE57> handle;
    std::vector<E57Scan> scans;
    std::size_t images = 0;
    std::string coordinate_metadata; ///< WKT of a coordinate system by the standard, unchecked; or ""
};

/// The state of reading a scan.
struct E57Points {
    std::unique_ptr<scan_e57_points, CloseE57> handle;
};

/// Reads the descriptions of all scans. Throws Error (kBadInput, without the file's name) if the file is malformed.
/// @param bytes of the file; they must outlive everything opened from it
E57File openE57(std::string_view bytes);

/// Starts at the first point of a scan. Throws Error if there are no points where the file locates them.
E57Points e57Points(const E57File& file, std::size_t scan);

/// Reads up to capacity points and returns their number; 0 after the last. Throws Error if the data is malformed;
/// checks the checksum of every page.
/// @param columns an array for each column of int64_t (kWhole, kScaled), float or double; null to skip the column
std::size_t readE57Points(E57Points& points, std::size_t capacity, void* const* columns);

/// The byte of the file that is read next, or slightly before.
std::uint64_t e57Position(const E57Points& points);

} // namespace pointrt
