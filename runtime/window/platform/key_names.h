// SPDX-License-Identifier: Apache-2.0
// Translation of GLFW's keys.
#pragma once

#include "runtime/window/input/events.h"

namespace pointrt {

/// Maps a GLFW key to a Key. Letters follow the keyboard layout, so that Ctrl+C is where the user expects it; keypad
/// keys map to digits.
/// @param key GLFW_KEY_...
/// @param name the key's label in the layout (glfwGetKeyName); null for keys that print nothing
Key keyFromGlfw(int key, const char* name);

} // namespace pointrt
