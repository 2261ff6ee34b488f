// SPDX-License-Identifier: Apache-2.0
// A record of LEAF, unpacked.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pointrt/pro_layout.h"

namespace pointrt::format {

struct Leaf {
    std::uint32_t first_member, member_count; ///< splats
    std::uint32_t first_ref, ref_count;       ///< words of REFS
    std::uint32_t reserved;
};

inline Leaf loadLeaf(const std::uint32_t* leaves, std::size_t index) {
    const std::uint32_t* words = leaves + index * PRO_LEAF_WORDS;
    const std::uint32_t counts = words[PRO_LEAF_COUNTS];
    return {words[PRO_LEAF_FIRST_MEMBER], counts & PRO_LEAF_MEMBER_MASK, words[PRO_LEAF_FIRST_REF],
            counts >> PRO_LEAF_REF_SHIFT, words[PRO_LEAF_RESERVED]};
}

} // namespace pointrt::format
