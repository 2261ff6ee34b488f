// SPDX-License-Identifier: Apache-2.0
// Memory aligned to pages.
#pragma once

#include <cstddef>

namespace pointrt {

/// Size of the huge pages that the system may use for large blocks aligned to them, in bytes.
inline constexpr std::size_t kHugePage = std::size_t{2} << 20;

/// A block of `bytes` bytes, a multiple of `alignment`, which is a power of 2. Uses huge pages if `alignment` is
/// kHugePage. Null if there is no memory.
void* allocatePages(std::size_t alignment, std::size_t bytes);
void freePages(void* memory);

/// Drops the whole pages among `bytes` bytes from `start`, the start of a mapping, from the memory of this process but
/// not from the file cache; reading them maps them again.
void dropPages(const void* start, std::size_t bytes);

} // namespace pointrt
