// SPDX-License-Identifier: Apache-2.0
// Header and records of a LAS file as text, which a .pro keeps under "source_header".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "format/pointio/las.h"

namespace pointrt {

/// JSON: "format" ("las"), "point_format", "packed", "scale", "offset" for people; "header" (base64, the public header
/// block) and "vlrs" (each "user_id", "record_id", "description", "extended", "data" in base64) for a writer. Omits
/// records on the layout of the file, waveforms, and records beyond 1 MiB in total, for which it adds a note to the
/// file.
/// @param moved the points have left the coordinate system, so its records are omitted, too
std::string lasSourceHeader(LasFile& file, bool moved);

/// The header and records for a writer.
struct LasSource {
    LasHeader header;
    std::string header_bytes; ///< the public header block
    struct Record {
        LasVlr vlr; ///< without its data
        std::string data;
    };
    std::vector<Record> records;
};

/// nullopt if the text is not as lasSourceHeader writes it.
std::optional<LasSource> parseLasSource(std::string_view json);

} // namespace pointrt
