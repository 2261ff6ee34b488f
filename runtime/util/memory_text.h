// SPDX-License-Identifier: Apache-2.0
// Amounts of memory in messages.
#pragma once

#include <cstdint>
#include <string>

namespace pointrt {

/// "1.5 GiB", rounded up to a tenth.
std::string gibibytes(std::uint64_t bytes);
/// "1536 MiB", rounded up.
std::string mebibytes(std::uint64_t bytes);

/// A size and a smaller limit, for a message.
struct SizeAndLimit {
    std::string size, limit;
};
/// Both in one unit, gibibytes or mebibytes; in bytes if rounding would make them look equal.
SizeAndLimit sizeAndLimit(std::uint64_t size, std::uint64_t limit, std::string (*inUnit)(std::uint64_t bytes));

} // namespace pointrt
