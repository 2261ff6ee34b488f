// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes of Potree octrees in the encoding BROTLI.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

enum class PotreeKind { kPosition, kColor, kOther };

/// A value of each point, at a byte of its record in the encoding DEFAULT.
struct PotreeColumn {
    std::size_t at = 0, size = 0;
    PotreeKind kind = PotreeKind::kOther; ///< position: three int32; colour: three uint16
};

/// Unpacks a node to records of the encoding DEFAULT. Throws Error if the data is invalid. The caller limits the number
/// of points.
std::string unpackPotreeNode(const InputFile& file, std::string_view packed, std::span<const PotreeColumn> columns,
                             std::size_t record_bytes, std::uint64_t points);

} // namespace pointrt
