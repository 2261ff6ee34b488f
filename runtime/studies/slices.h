// SPDX-License-Identifier: Apache-2.0
// Rows in slices, on all cores.
#pragma once

#include <algorithm>
#include <cstddef>

#include "format/base/parallel.h"

namespace pointrt {

/// Rows of a slice: some tenths of a millisecond's work, and enough of them for many cores in a batch.
constexpr std::size_t kSliceRows = 8192;

inline std::size_t sliceCount(std::size_t rows) { return (rows + kSliceRows - 1) / kSliceRows; }

/// Calls work(slice, first, last) for each slice [first, last) of [0, rows), in any order.
template <typename Work>
void forSlices(std::size_t rows, const Work& work) {
    forAll(sliceCount(rows), [&](std::size_t k) { work(k, k * kSliceRows, std::min(rows, (k + 1) * kSliceRows)); });
}

} // namespace pointrt
