// SPDX-License-Identifier: Apache-2.0
#include "format/pro/attributes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "format/base/number_type.h"
#include "format/base/parallel.h"
#include "format/pro/header.h"

namespace pointrt::format {

namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};

template <typename Value>
Range rangeOf(const std::byte* values, std::size_t count) {
    Range range;
    for (std::size_t i = 0; i < count; ++i) {
        Value value;
        std::memcpy(&value, values + i * sizeof value, sizeof value);
        const auto number = static_cast<double>(value);
        if (!std::isfinite(number)) continue;
        range.low = std::min(range.low, number);
        range.high = std::max(range.high, number);
    }
    return range;
}

/// Numbers in a block, the unit of work of a thread.
constexpr std::size_t kBlock = std::size_t{1} << 20;

} // namespace

pro_attribute loadAttribute(const Content& content, std::size_t i) {
    pro_attribute attribute{};
    const std::byte* record = content.attribute_records + i * PRO_ATTRIBUTE_BYTES;
    std::memcpy(attribute.name, record + PRO_ATTR_OFF_NAME, PRO_ATTRIBUTE_NAME_MAX);
    attribute.type = loadU32(record, PRO_ATTR_OFF_TYPE);
    attribute.components = loadU32(record, PRO_ATTR_OFF_COMPONENTS);
    std::memcpy(&attribute.low, record + PRO_ATTR_OFF_LOW, sizeof attribute.low);
    std::memcpy(&attribute.high, record + PRO_ATTR_OFF_HIGH, sizeof attribute.high);
    if (i < content.attribute_values.size()) attribute.values = content.attribute_values[i];
    return attribute;
}

void storeAttribute(std::byte* record, const pro_attribute& attribute) {
    std::memset(record, 0, PRO_ATTRIBUTE_BYTES);
    std::memcpy(record + PRO_ATTR_OFF_NAME, attribute.name, strnlen(attribute.name, PRO_ATTRIBUTE_NAME_MAX));
    storeU32(record, PRO_ATTR_OFF_TYPE, attribute.type);
    storeU32(record, PRO_ATTR_OFF_COMPONENTS, attribute.components);
    std::memcpy(record + PRO_ATTR_OFF_LOW, &attribute.low, sizeof attribute.low);
    std::memcpy(record + PRO_ATTR_OFF_HIGH, &attribute.high, sizeof attribute.high);
}

void findRange(pro_attribute& attribute, std::size_t count) {
    const auto* values = static_cast<const std::byte*>(attribute.values);
    std::vector<Range> blocks((count + kBlock - 1) / kBlock);
    forAll(blocks.size(), [&](std::size_t block) {
        const std::size_t first = block * kBlock, numbers = std::min(kBlock, count - first);
        blocks[block] = withType(attribute.type, [&](auto value) {
            return rangeOf<decltype(value)>(values + first * sizeof value, numbers);
        });
    });
    Range all;
    for (const Range& block : blocks) all = {std::min(all.low, block.low), std::max(all.high, block.high)};
    const bool any = all.low <= all.high;
    attribute.low = any ? all.low : 0;
    attribute.high = any ? all.high : 0;
}

} // namespace pointrt::format

uint32_t pro_type_bytes(uint32_t type) {
    if (type < PRO_TYPE_I8 || type > PRO_TYPE_F64) return 0;
    return pointrt::withType(type, [](auto value) { return static_cast<uint32_t>(sizeof value); });
}

double pro_attribute_value(const pro_attribute* attribute, size_t number) {
    return pointrt::withType(attribute->type, [&](auto value) {
        std::memcpy(&value, static_cast<const std::byte*>(attribute->values) + number * sizeof value, sizeof value);
        return static_cast<double>(value);
    });
}
