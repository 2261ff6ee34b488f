// SPDX-License-Identifier: Apache-2.0
// Memory available to this process.
#pragma once

#include <cstdint>
#include <string>

namespace pointrt {

/// Bytes: the minimum of the machine's free memory and swap (file caches count as free), of what is left of the
/// process's address space (ulimit -v), and of what is left of the limits of its control groups. The largest number if
/// unknown.
std::uint64_t availableMemory();

/// "1.5 GiB", rounded up to a tenth.
std::string gibibytes(std::uint64_t bytes);
/// "1536 MiB", rounded up.
std::string mebibytes(std::uint64_t bytes);

/// A size and a smaller limit, for a message.
struct SizeAndLimit {
    std::string size, limit;
};
/// Both in a unit, gibibytes or mebibytes; if rounding would make them look equal, in bytes.
SizeAndLimit sizeAndLimit(std::uint64_t size, std::uint64_t limit, std::string (*inUnit)(std::uint64_t bytes));

} // namespace pointrt
