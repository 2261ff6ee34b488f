// SPDX-License-Identifier: Apache-2.0
// The sections ATTD and ATTR: records to structs and back, ranges of values.
#pragma once

#include <cstddef>
#include <cstdint>

#include "format/pro/sections.h"
#include "pointrt/pro.h"

namespace pointrt::format {

/// Attribute i of content. Its values are null if its section is absent. The name is terminated; nothing else is
/// checked.
pro_attribute loadAttribute(const Content& content, std::size_t i);

/// Writes a record of ATTD (PRO_ATTRIBUTE_BYTES).
void storeAttribute(std::byte* record, const pro_attribute& attribute);

/// Sets low and high to the smallest and the largest finite number of count values; both to 0 if none is finite.
void findRange(pro_attribute& attribute, std::size_t count);

} // namespace pointrt::format
