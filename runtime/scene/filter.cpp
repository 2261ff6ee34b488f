// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "format/base/printable.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

[[noreturn]] void refuseFilter(const std::string& text) {
    throw std::invalid_argument("\"" + printable(text) +
                                "\" is not a filter such as class=2,6 or the range height=10:25.5");
}

double numberIn(const std::string& word, const std::string& text) {
    double number = 0;
    if (parseNumber(word, number) && std::isfinite(number)) return number;
    refuseFilter(text);
}

std::vector<ValueRange> rangesOf(const std::string& words, const std::string& text) {
    if (const std::size_t colon = words.find(':'); colon != std::string::npos) {
        const ValueRange range{numberIn(words.substr(0, colon), text), numberIn(words.substr(colon + 1), text)};
        if (!(range.low <= range.high)) refuseFilter(text);
        return {range};
    }
    std::vector<ValueRange> ranges;
    for (std::size_t start = 0; start <= words.size();) {
        const std::size_t end = std::min(words.find(',', start), words.size());
        const double number = numberIn(words.substr(start, end - start), text);
        ranges.push_back({number, number});
        start = end + 1;
    }
    return ranges;
}

} // namespace

bool holdsNumber(const std::vector<ValueRange>& ranges, double number) {
    return std::any_of(ranges.begin(), ranges.end(),
                       [number](ValueRange range) { return range.low <= number && number <= range.high; });
}

FilterDescription parseFilter(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos) refuseFilter(text);
    return {{text.substr(0, equals), rangesOf(text.substr(equals + 1), text)}, true, "--only: "};
}

bool hidesSplats(const FilterDescription& filter) { return filter.enabled && !filter.shown.ranges.empty(); }

bool hidesSplats(const std::vector<FilterDescription>& filters) {
    return std::any_of(filters.begin(), filters.end(), [](const FilterDescription& each) { return hidesSplats(each); });
}

} // namespace pointrt
