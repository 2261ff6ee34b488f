// SPDX-License-Identifier: GPL-3.0-or-later
// The lod-meta.json of a SOG: which files hold which level of detail.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

/// A range of the Gaussians of one file.
struct SogRange {
    std::uint64_t first = 0, count = 0;
};

/// A file with the ranges to read of it, which do not overlap.
struct SogLevelFile {
    std::string name; ///< of its meta.json, relative to the lod-meta.json
    std::vector<SogRange> ranges;
};

struct SogLevels {
    int count = 0;                    ///< of levels
    std::vector<SogLevelFile> files;  ///< of the chosen level
    std::optional<std::string> scene; ///< the name of the meta.json of the surroundings, which have no levels
};

/// Parses the file and chooses, for each part of the scene, its level that comes closest to the wanted one.
/// @param level the finest to read, counted from the coarsest, 0, on; nullopt: the finest there is
SogLevels parseSogLevels(const InputFile& input, std::optional<int> level);

} // namespace pointrt
