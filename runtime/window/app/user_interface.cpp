// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/app/user_interface.h"

#include <imgui.h>

#include <utility>

#include "runtime/image/image_png.h"
#include "runtime/window/ui/panel_ui.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {

UserInterface::UserInterface(Host& host) : host_(host), context_(ImGui::CreateContext()) {
    ImGui::GetIO().IniFilename = nullptr; // write no configuration file
    setUpUiInput();
    host_.useClipboardForUi();
    fitText();
}

UserInterface::~UserInterface() { ImGui::DestroyContext(context_); }

/// Rebuilds the fonts when the screen's scale changes.
void UserInterface::fitText() {
    if (host_.size().scale == text_scale_) return;
    text_scale_ = host_.size().scale;
    setUpUiStyle(host_.textScale(), static_cast<float>(text_scale_));
    setUiFont(host_.device(), host_.presenter());
    setUiTheme(light_theme_);
}

void UserInterface::fitTheme(bool light) {
    if (std::exchange(light_theme_, light) != light) setUiTheme(light);
}

std::vector<Command> UserInterface::handleEvent(const InputEvent& event, double now_s) {
    const ImGuiIO& io = ImGui::GetIO();
    controls_.ui_wants_mouse = io.WantCaptureMouse;
    controls_.ui_wants_keyboard = io.WantTextInput;
    const auto* key = std::get_if<KeyEvent>(&event);
    if (key && key->key == Key::kEscape && key->down && !io.WantTextInput && closePopup()) return {};
    feedImGui(input_, event);
    return interpret(controls_, event, now_s);
}

void UserInterface::draw(Workspace& work, double seconds) {
    fitText();
    fitTheme(work.light_theme);
    beginUiFrame(input_, host_.size(), seconds);
    drawUi(work);
    ImGui::Render();
    host_.setCursor(uiCursor());
}

void UserInterface::present(const std::function<void(VkCommandBuffer)>& uploads) {
    pointrt::present(host_.device(), host_.presenter(), ImGui::GetDrawData(), uploads);
}

void UserInterface::savePng(const std::string& path) {
    writePng(path, readFrame(host_.device(), host_.presenter(), ImGui::GetDrawData()));
}

} // namespace pointrt
