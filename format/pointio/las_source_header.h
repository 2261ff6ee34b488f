// SPDX-License-Identifier: Apache-2.0
// What a LAS file says beside its points, as the text that a .pro keeps under "source_header".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "format/pointio/las.h"

namespace pointrt {

/// JSON: "format" ("las"), "point_format", "packed", "scale", "offset" for people; "header" (base64, the public header
/// block) and "vlrs" (each "user_id", "record_id", "description", "extended", "data" in base64) for a writer. Records
/// that describe how this file lies on disk, waveforms and what is past 1 MiB in all is left out; the last is added to
/// the file's notes. moved: the points are not where the coordinate system says any more, so it is left out too.
std::string lasSourceHeader(LasFile& file, bool moved);

/// What a writer takes from it.
struct LasSource {
    LasHeader header;
    std::string header_bytes; ///< all of it
    struct Record {
        LasVlr vlr; ///< without its data
        std::string data;
    };
    std::vector<Record> records;
};

/// Nothing where the text is not what lasSourceHeader writes.
std::optional<LasSource> parseLasSource(std::string_view json);

} // namespace pointrt
