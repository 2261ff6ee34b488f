// SPDX-License-Identifier: Apache-2.0
// Words of a recording: names of keys and buttons, and strings in quotes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/window/input/events.h"

namespace pointrt {

/// "A", "F12", "PageUp"; "Unknown" for what has no name.
std::string keyName(Key key);
/// Large and small letters alike; nothing where no key is called name.
std::optional<Key> keyNamed(std::string_view name);

const char* buttonName(MouseButton button);
std::optional<MouseButton> buttonNamed(std::string_view name);

/// Takes the next character of UTF-8 off bytes, which is not empty. Nothing, and bytes as it was, where it is none.
std::optional<std::uint32_t> takeCodePoint(std::string_view& bytes);
/// In UTF-8; U+FFFD for what is no character.
std::string utf8Of(std::uint32_t code_point);

/// bytes in quotes, on one line of valid UTF-8, whatever they are.
std::string quotedText(std::string_view bytes);

struct RecordingWord {
    std::string text; ///< without quotes and escapes
    bool in_quotes = false;
};

/// The words of a line up to its comment. Throws std::invalid_argument with the reason.
std::vector<RecordingWord> recordingWords(std::string_view line);

} // namespace pointrt
