// SPDX-License-Identifier: Apache-2.0
// Parallel loops over slices of rows.
#pragma once

#include <algorithm>
#include <cstddef>

#include "format/base/parallel.h"

namespace pointrt {

/// Some tenths of a millisecond of work, and still enough slices in a batch for many cores.
constexpr std::size_t kSliceRows = 8192;

inline std::size_t sliceCount(std::size_t rows) { return (rows + kSliceRows - 1) / kSliceRows; }

/// Calls work(slice, first, last) for each slice [first, last) of [0, rows), in any order.
template <typename Work>
void forSlices(std::size_t rows, const Work& work) {
    forAll(sliceCount(rows), [&](std::size_t k) { work(k, k * kSliceRows, std::min(rows, (k + 1) * kSliceRows)); });
}

} // namespace pointrt
