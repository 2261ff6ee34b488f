// SPDX-License-Identifier: Apache-2.0
// Which of several names a mistyped one is meant to be.
#pragma once

#include <span>
#include <string_view>

namespace pointrt {

/// The one of names that is nearest to text by the number of characters to change, add or take away; where none is
/// near, the first that begins with text. "" where there is none of these either. Near is up to a third of text.
std::string_view nearestName(std::string_view text, std::span<const std::string_view> names);

} // namespace pointrt
