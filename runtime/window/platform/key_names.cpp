// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/key_names.h"

#include <utility>

#include "runtime/window/platform/glfw.h"

namespace pointrt {
namespace {

constexpr std::pair<int, Key> kNamedKeys[] = {
    {GLFW_KEY_ESCAPE, Key::kEscape},
    {GLFW_KEY_ENTER, Key::kEnter},
    {GLFW_KEY_KP_ENTER, Key::kEnter},
    {GLFW_KEY_TAB, Key::kTab},
    {GLFW_KEY_BACKSPACE, Key::kBackspace},
    {GLFW_KEY_DELETE, Key::kDelete},
    {GLFW_KEY_LEFT, Key::kLeft},
    {GLFW_KEY_RIGHT, Key::kRight},
    {GLFW_KEY_UP, Key::kUp},
    {GLFW_KEY_DOWN, Key::kDown},
    {GLFW_KEY_HOME, Key::kHome},
    {GLFW_KEY_END, Key::kEnd},
    {GLFW_KEY_PAGE_UP, Key::kPageUp},
    {GLFW_KEY_PAGE_DOWN, Key::kPageDown},
    {GLFW_KEY_LEFT_SHIFT, Key::kShift},
    {GLFW_KEY_RIGHT_SHIFT, Key::kShift},
    {GLFW_KEY_LEFT_CONTROL, Key::kControl},
    {GLFW_KEY_RIGHT_CONTROL, Key::kControl},
    {GLFW_KEY_LEFT_ALT, Key::kAlt},
    {GLFW_KEY_RIGHT_ALT, Key::kAlt},
    {GLFW_KEY_KP_DECIMAL, keyOf('.')},
    {GLFW_KEY_KP_DIVIDE, keyOf('/')},
    {GLFW_KEY_KP_MULTIPLY, keyOf('*')},
    {GLFW_KEY_KP_SUBTRACT, keyOf('-')},
    {GLFW_KEY_KP_ADD, keyOf('+')},
};

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

} // namespace

Key keyFromGlfw(int key, const char* name) {
    for (const auto& [theirs, ours] : kNamedKeys)
        if (theirs == key) return ours;
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
        return static_cast<Key>(static_cast<int>(Key::kF1) + key - GLFW_KEY_F1);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return static_cast<Key>('0' + key - GLFW_KEY_KP_0);
    // GLFW's printable keys are the characters of the US layout
    if (key < GLFW_KEY_SPACE || key > GLFW_KEY_GRAVE_ACCENT) return Key::kUnknown;
    constexpr char kToUpper = 'a' - 'A';
    if (name && isLetter(name[0]) && name[1] == 0) return keyOf(name[0] >= 'a' ? name[0] - kToUpper : name[0]);
    return static_cast<Key>(key);
}

} // namespace pointrt
