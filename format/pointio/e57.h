// SPDX-License-Identifier: Apache-2.0
// E57 files (ASTM E2807): their scans, and the points of each as the file stores them.
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

/// Whether this build has what reads E57: POINTRT_LAZ_E57. Where not, openE57 throws Error (kCannotRun) that says what
/// to install.
bool hasE57();

/// What a column holds: raw whole numbers of which the value is the number itself, or offset + scale * number; or
/// reals.
enum class E57Kind { kWhole, kScaled, kSingle, kDouble };

struct E57Column {
    std::string name; ///< as in the standard, "cartesianX"; "PREFIX:NAME", or "NAME", of an extension
    E57Kind kind = E57Kind::kDouble;
    std::int64_t least = 0, most = 0; ///< raw whole numbers; all of 64 bits where the file says nothing
    double scale = 1, offset = 0;
};

struct E57Limits {
    double least = 0, most = 0;
};

struct E57Scan {
    std::string name, guid;
    std::uint64_t points = 0; ///< as promised; those of all scans together fit in the file's bytes
    std::vector<E57Column> columns;
    bool has_pose = false;
    std::array<double, 4> rotation = {1, 0, 0, 0}; ///< w x y z, of any length: file = rotation * scan + translation
    std::array<double, 3> translation = {0, 0, 0}; ///< metres
    std::array<std::optional<E57Limits>, 3> color_limits; ///< the scan's, or else those of the columns' types
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
    std::string coordinate_metadata; ///< well-known text of a coordinate system, as it should be; or ""
};

/// Where reading of a scan stands.
struct E57Points {
    std::unique_ptr<scan_e57_points, CloseE57> handle;
};

/// Reads what a file says of its scans. Throws Error (kBadInput, a reason without the file's name) when it is broken.
/// @param bytes all of the file, as long as anything that was opened of it lives
E57File openE57(std::string_view bytes);

/// Starts with a scan's first point. Throws Error when they are not where the file says.
E57Points e57Points(const E57File& file, std::size_t scan);

/// Reads the next points, capacity at most, and returns how many; 0 after the last. Throws Error when the data is
/// broken: checksums of all pages read are checked.
/// @param columns for each column an array of int64_t (kWhole, kScaled), float or double, or null: not wanted
std::size_t readE57Points(E57Points& points, std::size_t capacity, void* const* columns);

/// Where in the file the next points are, or shortly before.
std::uint64_t e57Position(const E57Points& points);

} // namespace pointrt
