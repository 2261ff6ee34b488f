// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/controls.h"

#include <algorithm>
#include <string_view>

namespace pointrt {
namespace {

bool isShown(const Control& control) { return *control.press != '\0'; }

std::size_t widestPress() {
    std::size_t widest = 0;
    for (const Control& control : kControls) widest = std::max(widest, std::string_view(control.press).size());
    return widest;
}

/// Removes Markdown's backquotes.
std::string withoutQuotes(std::string text) {
    std::erase(text, '`');
    return text;
}

} // namespace

const Control* findControl(Gesture gesture, Key key, bool with_control, bool with_shift) {
    for (const Control& control : kControls)
        if (control.gesture == gesture && control.key == key && control.with_control == with_control &&
            control.with_shift == (with_control && with_shift))
            return &control;
    return nullptr;
}

std::string markdownTable() {
    std::string table = "| | input | action |\n|---|---|---|\n";
    std::string_view group;
    for (const Control& control : kControls) {
        if (!isShown(control)) continue;
        const bool begins = group != control.group;
        group = control.group;
        table += std::string("| ") + (begins ? "**" + std::string(group) + "** | " : "| ") + control.press + " | " +
                 control.does + " |\n";
    }
    return table;
}

std::string helpText() {
    const std::size_t column = widestPress() + 2;
    std::string text;
    std::string_view group;
    for (const Control& control : kControls) {
        if (!isShown(control)) continue;
        if (group != control.group) text += (text.empty() ? "" : "\n") + std::string(control.group) + "\n";
        group = control.group;
        std::string press = control.press;
        press.resize(column, ' ');
        text += "  " + press + withoutQuotes(control.does) + "\n";
    }
    return text;
}

} // namespace pointrt
