// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "preprocess/cloud/cloud.h"

namespace pointrt::test {

/// The attribute of this name; null if there is none.
inline const Attribute* findAttribute(const Cloud& cloud, std::string_view name) {
    for (const Attribute& attribute : cloud.attributes)
        if (attribute.name == name) return &attribute;
    return nullptr;
}

} // namespace pointrt::test
