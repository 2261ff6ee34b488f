// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of a scan that its reader declares before the points, and its range in the cloud afterwards.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/columns.h"

namespace pointrt {

/// Placement of a scan in the input's frame: input = linear * scan + translation. A rotation, unless the file scales.
struct Pose {
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    Vec3d translation = Vec3d::Zero();
};

/// How colour values become 8-bit ones. Bytes stay as they are. Integers are taken for 16-bit values if any exceeds
/// 255. Reals are in [0, 1]; if any exceeds 1, they are treated as integers. 16-bit colours are in a column kRgb16
/// beside the row: their largest value determines the scale, and the attribute keeps all bits.
enum class ColorScale { kByte, kInteger, kReal, k16Bit };

/// Properties that a reader declares before the first vertex.
struct ScanTraits {
    bool normals = false;
    bool normal_sides = true; ///< false: normals are axes without a sign, to be oriented later
    bool colors = false;
    bool radii = false;
    bool faces = true; ///< false: no polygon will follow, so indices of dropped vertices need not be kept
    ColorScale color_scale = ColorScale::kByte;
    bool withholds = false;            ///< a column kWithheld of bytes flags points to be left out
    std::vector<ColumnTraits> columns; ///< attributes, in the order of the values given to Sink::addVertex
    /// Expected number of vertices, 0 if unknown: reserves memory and measures progress.
    std::uint64_t vertices = 0;
};

/// Where a vertex has the value of a column.
struct ColumnPlace {
    std::size_t column = 0; ///< index into ScanTraits::columns
    std::size_t offset = 0; ///< in a vertex's packed values, in bytes
    Scalar type = Scalar::kU8;
};

/// The first column of this name.
std::optional<ColumnPlace> findColumn(const ScanTraits& traits, std::string_view name);

/// The range of points in the cloud that came from one scan.
struct ScanRange {
    std::string name; ///< of the file
    std::size_t first_position = 0, position_count = 0;
    bool has_faces = false;
};

/// The box around a scan's points, input coordinates.
struct ScanBox {
    Vec3d center, size;
};

} // namespace pointrt
