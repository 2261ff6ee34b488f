// SPDX-License-Identifier: Apache-2.0
// GLFW's keys as ours.
#pragma once

#include "runtime/window/input/events.h"

namespace pointrt {

/// The key that GLFW calls key and, with the user's keyboard layout, name (null where it has none). Letters follow the
/// layout, so that Ctrl+C is where the user has C; the keypad's digits are digits.
Key keyFromGlfw(int key, const char* name);

} // namespace pointrt
