// SPDX-License-Identifier: Apache-2.0
// Splits lines into words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// Separators between the numbers and names of a line.
constexpr std::string_view kBetweenWords = " ,;\t\r";

/// The words of a line, as views of it.
std::vector<std::string_view> wordsOf(std::string_view line);

/// A word that a user gave, for a message: printable, truncated and in double quotes.
std::string quotedWord(std::string_view word);

/// Converts A-Z to a-z.
std::string lowerCase(std::string_view text);

} // namespace pointrt
