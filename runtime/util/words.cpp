// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/words.h"

#include <algorithm>
#include <cctype>

#include "format/base/printable.h"

namespace pointrt {

std::vector<std::string_view> wordsOf(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t start = 0; (start = line.find_first_not_of(kBetweenWords, start)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(kBetweenWords, start), line.size());
        words.push_back(line.substr(start, end - start));
        start = end;
    }
    return words;
}

std::string quotedWord(std::string_view word) { return "\"" + printable(word, 40) + "\""; }

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

} // namespace pointrt
