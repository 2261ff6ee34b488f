// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace pointrt {

/// Keeps the values with a set flag, in order. An empty array stays empty.
template <typename Value, typename Flag>
void keepFlagged(std::vector<Value>& values, const std::vector<Flag>& keep) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i]) values[kept++] = values[i];
    values.resize(kept);
}

} // namespace pointrt
