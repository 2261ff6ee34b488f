// SPDX-License-Identifier: Apache-2.0
// What the sections ATTD and ATTR say: records to structs and back, values as numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "format/pro/header.h"
#include "pointrt/pro.h"

namespace pointrt::format {

/// Number i of content's attributes; values may be null where its section is not there. Nothing is checked, but that
/// the name ends.
pro_attribute loadAttribute(const Content& content, std::size_t i);

/// Writes an attribute's record (PRO_ATTRIBUTE_BYTES of them).
void storeAttribute(std::byte* record, const pro_attribute& attribute);

/// Sets low and high to the least and the greatest finite one of count numbers.
void findRange(pro_attribute& attribute, std::size_t count);

} // namespace pointrt::format
