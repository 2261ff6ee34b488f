// SPDX-License-Identifier: Apache-2.0
// Dear ImGui over a host: what it makes of input, and what it draws.
#pragma once

#include <vector>

#include "runtime/window/app/host.h"
#include "runtime/window/edit/workspace.h"
#include "runtime/window/input/commands.h"
#include "runtime/window/ui/ui_input.h"

struct ImGuiContext;

namespace pointrt {

/// Holds Dear ImGui's context for as long as it lives.
class UserInterface {
public:
    /// host must outlive it.
    explicit UserInterface(Host& host);
    ~UserInterface();
    UserInterface(const UserInterface&) = delete;
    UserInterface& operator=(const UserInterface&) = delete;

    /// What event means that is not the panels' own.
    std::vector<Command> handleEvent(const InputEvent& event, double now_s);
    bool isDragging() const { return controls_.drag.has_value(); }

    /// Lets the panels draw, and write to work what the user asks for. seconds: since the frame before.
    void draw(Workspace& work, double seconds);
    /// What was drawn, over the picture, to the screen.
    void present();
    /// Writes the same to a PNG.
    void savePng(const std::string& path);

private:
    void fitText();

    Host& host_;
    ImGuiContext* context_;
    UiInput input_;
    ControlState controls_;
    double text_scale_ = 0; ///< that the fonts are made for
};

} // namespace pointrt
