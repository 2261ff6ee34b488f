// SPDX-License-Identifier: Apache-2.0
// Tokens of recordings: names of keys and buttons, and quoted strings.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/window/input/events.h"

namespace pointrt {

/// "A", "F12", "PageUp"; "Unknown" for unnamed keys.
std::string keyName(Key key);
/// Ignores case; none for unknown names.
std::optional<Key> keyNamed(std::string_view name);

const char* buttonName(MouseButton button);
std::optional<MouseButton> buttonNamed(std::string_view name);

/// Removes the first UTF-8 character from bytes, which must not be empty. If the character is invalid, returns none and
/// leaves bytes unchanged.
std::optional<std::uint32_t> takeCodePoint(std::string_view& bytes);
/// UTF-8 of a code point; U+FFFD if it is invalid.
std::string utf8Of(std::uint32_t code_point);

/// Any bytes as a quoted string: valid UTF-8 on one line.
std::string quotedText(std::string_view bytes);

struct RecordingWord {
    std::string text; ///< without quotes and escapes
    bool in_quotes = false;
};

/// The tokens of a line, without its comment. Throws std::invalid_argument with the reason.
std::vector<RecordingWord> recordingWords(std::string_view line);

} // namespace pointrt
