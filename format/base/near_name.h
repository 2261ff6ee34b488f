// SPDX-License-Identifier: Apache-2.0
// "Did you mean": the closest of several names.
#pragma once

#include <span>
#include <string_view>

namespace pointrt {

/// The name with the smallest edit distance to text, at most a third of text's length, rounded up; else the first name
/// that starts with text; else "".
std::string_view nearestName(std::string_view text, std::span<const std::string_view> names);

} // namespace pointrt
