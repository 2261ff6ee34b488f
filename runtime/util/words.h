// SPDX-License-Identifier: Apache-2.0
// Words of a row of text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// What stands between the numbers and names of a row.
constexpr std::string_view kBetweenWords = " ,;\t\r";

/// The words of a line, views of it.
std::vector<std::string_view> wordsOf(std::string_view line);

/// A to Z as a to z.
std::string lowerCase(std::string_view text);

} // namespace pointrt
