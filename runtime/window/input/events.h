// SPDX-License-Identifier: Apache-2.0
// Input events of a window or a recording, as plain data.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace pointrt {

/// Keys that have a function. Letters and digits are their ASCII codes ('A' to 'Z', '0' to '9').
enum class Key : std::uint16_t {
    kUnknown = 0,
    kSpace = ' ',
    kEscape = 256,
    kEnter,
    kTab,
    kBackspace,
    kDelete,
    kLeft,
    kRight,
    kUp,
    kDown,
    kHome,
    kEnd,
    kPageUp,
    kPageDown,
    kShift,
    kControl,
    kAlt,
    kF1,
    kF12 = kF1 + 11,
};

constexpr Key keyOf(char letter_or_digit) { return static_cast<Key>(letter_or_digit); }

enum class MouseButton : std::uint8_t { kLeft, kRight, kMiddle };

struct KeyEvent {
    Key key = Key::kUnknown;
    bool down = true; ///< true again for each key repeat
};
/// A typed character, for text fields.
struct TextEvent {
    std::uint32_t code_point = 0;
};
struct ButtonEvent {
    MouseButton button = MouseButton::kLeft;
    bool down = true;
};
/// Cursor position in window units from the upper left corner, y down. It may be outside the window.
struct CursorEvent {
    double x = 0, y = 0;
};
/// y above 0: the wheel turns away from the user.
struct WheelEvent {
    double x = 0, y = 0;
};
/// Window units; scale is pixels per unit. 0 x 0: minimised.
struct ResizeEvent {
    std::uint32_t width = 0, height = 0;
    double scale = 1;
};
struct DropEvent {
    std::vector<std::string> paths;
};
struct CloseEvent {};

using InputEvent =
    std::variant<KeyEvent, TextEvent, ButtonEvent, CursorEvent, WheelEvent, ResizeEvent, DropEvent, CloseEvent>;

} // namespace pointrt
