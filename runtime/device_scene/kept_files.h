// SPDX-License-Identifier: Apache-2.0
// A folder of files that can be made again: the least recently used go where they take too much.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pointrt {

/// What the folder may hold, at most, of what the disk would have free without it: whoever needs the disk comes first.
constexpr std::uint64_t kKeptShareOfFree = 4; ///< a quarter

/// A folder that any number of processes may share. Of what is in it only files with its suffix count, and temporaries
/// of those (AtomicFile), which were left behind where they are old.
struct KeptFiles {
    std::string folder; ///< empty: nothing is kept
    std::string suffix;
    std::uint64_t most_bytes = 0;
};

/// Makes the folder, for the user alone, where it is missing, and takes away what was used the longest ago until so
/// many more bytes fit. False where there is no such folder, or they never do.
bool makeRoomFor(const KeptFiles& kept, std::uint64_t bytes);

/// Says that a file was used just now. What cannot be written goes as if it had not been.
void markUsed(const std::string& path);

} // namespace pointrt
