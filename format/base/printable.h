// SPDX-License-Identifier: Apache-2.0
// Escapes untrusted text from files and command lines for terminals.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pointrt {

/// Length in bytes at which a name or word in a message is truncated.
constexpr std::size_t kLongestShown = 80;

/// text on one line, safe to print. Control characters, bytes that are not UTF-8, and characters of zero width or that
/// change the writing direction become \n, \t, \r or \xHH. If it has more than `longest` bytes, it is truncated and
/// ends in "...". Idempotent.
std::string printable(std::string_view text, std::size_t longest = kLongestShown);

} // namespace pointrt
