// SPDX-License-Identifier: Apache-2.0
// Text from files and command lines as a terminal may show it: the one place that decides this.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pointrt {

/// A name or word in a message is cut behind so many bytes.
constexpr std::size_t kLongestShown = 80;

/// text on one line, with nothing in it that acts on a terminal or hides what stands around it: control characters,
/// bytes that are not UTF-8, and characters that turn the direction of writing or take no room, become \n, \t, \r or
/// \xHH. Of more than longest bytes the first ones, and "...". Applied twice it changes nothing more.
std::string printable(std::string_view text, std::size_t longest = kLongestShown);

} // namespace pointrt
