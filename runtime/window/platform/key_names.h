// SPDX-License-Identifier: Apache-2.0
// Translation of GLFW's keys.
#pragma once

#include "runtime/window/input/events.h"

namespace pointrt {

/// key: GLFW's code; name: the key's name in the keyboard layout, null if there is none. Letters follow the layout, so
/// that Ctrl+C is where the user expects it; keys of the keypad are digits.
Key keyFromGlfw(int key, const char* name);

} // namespace pointrt
