// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/ui_input.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <utility>

namespace pointrt {
namespace {

constexpr std::pair<ImGuiKey, Key> kUiKeys[] = {
    {ImGuiKey_Tab, Key::kTab},
    {ImGuiKey_LeftArrow, Key::kLeft},
    {ImGuiKey_RightArrow, Key::kRight},
    {ImGuiKey_UpArrow, Key::kUp},
    {ImGuiKey_DownArrow, Key::kDown},
    {ImGuiKey_PageUp, Key::kPageUp},
    {ImGuiKey_PageDown, Key::kPageDown},
    {ImGuiKey_Home, Key::kHome},
    {ImGuiKey_End, Key::kEnd},
    {ImGuiKey_Delete, Key::kDelete},
    {ImGuiKey_Backspace, Key::kBackspace},
    {ImGuiKey_Space, Key::kSpace},
    {ImGuiKey_Enter, Key::kEnter},
    {ImGuiKey_Escape, Key::kEscape},
    {ImGuiKey_A, keyOf('A')},
    {ImGuiKey_C, keyOf('C')},
    {ImGuiKey_V, keyOf('V')},
    {ImGuiKey_X, keyOf('X')},
    {ImGuiKey_Y, keyOf('Y')},
    {ImGuiKey_Z, keyOf('Z')},
};

// Since 1.89, ImGui takes input as events and has its own key numbers; earlier versions read the state at the start of
// a frame.
#if IMGUI_VERSION_NUM >= 18900

void setUpKeys(ImGuiIO& io) {
    // otherwise ImGui takes one event per frame, and the window does not redraw for the remaining ones
    io.ConfigInputTrickleEventQueue = false;
}

void setKey(ImGuiIO& io, Key key, bool down) {
    if (key == Key::kShift) io.AddKeyEvent(ImGuiMod_Shift, down);
    if (key == Key::kControl) io.AddKeyEvent(ImGuiMod_Ctrl, down);
    if (key == Key::kAlt) io.AddKeyEvent(ImGuiMod_Alt, down);
    if (uiKey(key) != ImGuiKey_None) io.AddKeyEvent(uiKey(key), down);
}

void setButton(ImGuiIO& io, std::size_t button, bool down) { io.AddMouseButtonEvent(static_cast<int>(button), down); }
void setCursor(ImGuiIO& io, float x, float y) { io.AddMousePosEvent(x, y); }
void turnWheel(ImGuiIO& io, float x, float y) { io.AddMouseWheelEvent(x, y); }

#else

void setUpKeys(ImGuiIO& io) {
    for (const auto& [theirs, ours] : kUiKeys) io.KeyMap[theirs] = static_cast<int>(ours);
}

void setKey(ImGuiIO& io, Key key, bool down) {
    io.KeysDown[static_cast<std::size_t>(key)] = down;
    if (key == Key::kShift) io.KeyShift = down;
    if (key == Key::kControl) io.KeyCtrl = down;
    if (key == Key::kAlt) io.KeyAlt = down;
}

void setButton(ImGuiIO& io, std::size_t button, bool down) { io.MouseDown[button] = down; }
void setCursor(ImGuiIO& io, float x, float y) { io.MousePos = ImVec2(x, y); }
void turnWheel(ImGuiIO& io, float x, float y) {
    io.MouseWheelH += x;
    io.MouseWheel += y;
}

#endif

/// Feeds one event.
struct Feeder {
    UiInput& input;
    ImGuiIO& io;

    void operator()(const KeyEvent& event) const {
        const auto& pressed = input.pressed_keys;
        const bool at_once = event.down || std::find(pressed.begin(), pressed.end(), event.key) == pressed.end();
        if (event.down) {
            input.pressed_keys.push_back(event.key);
            std::erase(input.released_keys, event.key);
        }
        if (at_once)
            setKey(io, event.key, event.down);
        else
            input.released_keys.push_back(event.key);
    }
    void operator()(const ButtonEvent& event) const {
        const auto button = static_cast<std::size_t>(event.button);
        if (event.down) input.pressed[button] = true;
        input.released[button] = !event.down && input.pressed[button];
        if (!input.released[button]) setButton(io, button, event.down);
    }
    void operator()(const TextEvent& event) const { io.AddInputCharacter(event.code_point); }
    void operator()(const CursorEvent& event) const {
        setCursor(io, static_cast<float>(event.x), static_cast<float>(event.y));
    }
    void operator()(const WheelEvent& event) const {
        turnWheel(io, static_cast<float>(event.x), static_cast<float>(event.y));
    }
    void operator()(const ResizeEvent&) const {}
    void operator()(const DropEvent&) const {}
    void operator()(const CloseEvent&) const {}
};

const char* getClipboard(void* window) {
    static std::string text; // valid until ImGui's next call
    text = clipboardText(*static_cast<PlatformWindow*>(window));
    return text.c_str();
}

void setClipboard(void* window, const char* text) { setClipboardText(*static_cast<PlatformWindow*>(window), text); }

} // namespace

ImGuiKey uiKey(Key key) {
#if IMGUI_VERSION_NUM >= 18900
    for (const auto& [theirs, ours] : kUiKeys)
        if (ours == key) return theirs;
    return ImGuiKey_None;
#else
    return static_cast<ImGuiKey>(key);
#endif
}

void setUpUiInput() {
    ImGuiIO& io = ImGui::GetIO();
    setUpKeys(io);
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    io.BackendPlatformName = "pointrt";
}

void feedImGui(UiInput& input, const InputEvent& event) { std::visit(Feeder{input, ImGui::GetIO()}, event); }

void beginUiFrame(UiInput& input, const ResizeEvent& size, double seconds) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
    io.DisplayFramebufferScale = ImVec2(static_cast<float>(size.scale), static_cast<float>(size.scale));
    io.DeltaTime = static_cast<float>(seconds);
    ImGui::NewFrame();
    for (std::size_t button = 0; button < input.released.size(); ++button)
        if (input.released[button]) setButton(io, button, false);
    for (Key key : input.released_keys) setKey(io, key, false);
    input = {};
}

bool closePopup() {
    const ImVector<ImGuiPopupData>& open = GImGui->OpenPopupStack;
    if (open.Size == 0 || !open.back().Window || (open.back().Window->Flags & ImGuiWindowFlags_Modal) != 0)
        return false;
    ImGui::ClosePopupToLevel(open.Size - 1, true);
    return true;
}

CursorShape uiCursor() {
    switch (ImGui::GetMouseCursor()) {
    case ImGuiMouseCursor_TextInput:
        return CursorShape::kText;
    case ImGuiMouseCursor_Hand:
        return CursorShape::kHand;
    case ImGuiMouseCursor_ResizeEW:
        return CursorShape::kResizeX;
    case ImGuiMouseCursor_ResizeNS:
        return CursorShape::kResizeY;
    case ImGuiMouseCursor_ResizeAll:
    case ImGuiMouseCursor_ResizeNESW:
    case ImGuiMouseCursor_ResizeNWSE:
        return CursorShape::kCross;
    default:
        return CursorShape::kArrow;
    }
}

void useClipboard(PlatformWindow& window) {
    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = &window;
    io.GetClipboardTextFn = getClipboard;
    io.SetClipboardTextFn = setClipboard;
}

} // namespace pointrt
