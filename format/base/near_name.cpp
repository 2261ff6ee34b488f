// SPDX-License-Identifier: Apache-2.0
#include "format/base/near_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <vector>

namespace pointrt {

namespace {

/// Characters to replace, insert or delete (Levenshtein 1966).
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row[b.size()];
}

} // namespace

std::string_view nearestName(std::string_view text, std::span<const std::string_view> names) {
    constexpr std::size_t longest = 64; // longer than any name
    if (text.size() > longest) return {};
    std::size_t least = (text.size() + 2) / 3 + 1;
    std::string_view nearest;
    for (const std::string_view name : names) {
        const std::size_t distance = editDistance(text, name);
        if (distance < least) std::tie(least, nearest) = std::tie(distance, name);
    }
    if (!nearest.empty() || text.size() < 2) return nearest; // a single letter begins many names
    const auto longer = std::find_if(names.begin(), names.end(), [&](auto name) { return name.starts_with(text); });
    return longer == names.end() ? std::string_view() : *longer;
}

} // namespace pointrt
