// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/setting_names.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace pointrt {
namespace {

constexpr std::string_view kOptionPrefix = "--";
constexpr std::string_view kOptionLetters = "abcdefghijklmnopqrstuvwxyz-";
constexpr std::string_view kBeforeWords = " (\"";

bool startsOption(const std::string& message, std::size_t at) {
    const bool starts_word = at == 0 || kBeforeWords.find(message[at - 1]) != std::string_view::npos;
    return starts_word && message.compare(at, kOptionPrefix.size(), kOptionPrefix) == 0;
}

} // namespace

std::string withSettingNames(const std::string& message) {
    std::string named;
    for (std::size_t at = 0; at < message.size();) {
        if (!startsOption(message, at)) {
            named += message[at++];
            continue;
        }
        const std::size_t start = at + kOptionPrefix.size();
        at = std::min(message.find_first_not_of(kOptionLetters, start), message.size());
        std::string name = message.substr(start, at - start);
        std::replace(name.begin(), name.end(), '-', '_');
        named += name;
    }
    return named;
}

} // namespace pointrt
