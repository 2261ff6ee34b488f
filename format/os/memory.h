// SPDX-License-Identifier: Apache-2.0
// Memory available to this process, and taken by it.
#pragma once

#include <cstdint>

namespace pointrt {

/// Bytes: the minimum of the machine's free memory and swap (file caches count as free), of what is left of the
/// process's address space (ulimit -v), and of what is left of the limits of its control groups. The largest number if
/// unknown.
std::uint64_t availableMemory();

/// The most memory that this process has had resident so far, in bytes.
std::uint64_t peakRssBytes();

} // namespace pointrt
