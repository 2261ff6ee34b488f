// SPDX-License-Identifier: Apache-2.0
// How much memory this process may still take.
#pragma once

#include <cstdint>
#include <string>

namespace pointrt {

/// Bytes: the least of what the machine has free (memory and swap; caches of files count as free), what is left of the
/// process's address space (ulimit -v), and what the control groups it is in have left, where they are limited. More
/// than there can be where the system does not tell.
std::uint64_t availableMemory();

/// "1.5 GiB", rounded up to a tenth.
std::string gibibytes(std::uint64_t bytes);
/// "1536 MiB", rounded up.
std::string mebibytes(std::uint64_t bytes);

} // namespace pointrt
