// SPDX-License-Identifier: Apache-2.0
// The table of all controls. Input handling, the cheat sheet and docs/WINDOW.md are made from it.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/window/input/events.h"

namespace pointrt {

enum class Action : std::uint8_t {
    // Continuous; commands.h turns these into commands with values.
    kOrbit,
    kPan,
    kZoom,
    kCentreOn,
    kPick,
    kFlyForward,
    kFlyLeft,
    kFlyBack,
    kFlyRight,
    kFlyDown,
    kFlyUp,
    // Immediate.
    kHome,
    kFrontView,
    kRightView,
    kTopView,
    kOppositeView,
    kOrthographic,
    kCopyCamera,
    kPasteCamera,
    kSaveView,
    kPreviousView,
    kNextView,
    kMeasurement,
    kKeepMeasurement,
    kPause,
    kScreenshot,
    kSaveScene,
    kOpen,
    kPalette,
    kUndo,
    kRedo,
    kPreviousFile,
    kNextFile,
    kPanel,
    kCheatSheet,
    kBack, ///< answers a question, or else closes the cheat sheet, cancels the job, or drops the picks; never quits
    kQuit,
};

enum class Gesture : std::uint8_t {
    kKey,
    kHeldKey,
    kLeftDrag,
    kShiftLeftDrag,
    kRightDrag,
    kWheel,
    kClick,
    kDoubleClick
};

struct Control {
    const char* press; ///< the gesture in words; "": an alternative to the row above, which names both gestures
    const char* group;
    const char* does;
    Gesture gesture;
    Key key; ///< kUnknown if the gesture has none
    bool with_control;
    Action action;
    bool with_shift = false; ///< matters with Ctrl only
};

constexpr Control mouseControl(const char* press, const char* group, const char* does, Gesture gesture, Action action) {
    return {press, group, does, gesture, Key::kUnknown, false, action};
}
constexpr Control keyControl(const char* press, const char* group, const char* does, Key key, Action action) {
    return {press, group, does, Gesture::kKey, key, false, action};
}
constexpr Control controlKey(const char* press, const char* group, const char* does, char letter, Action action) {
    return {press, group, does, Gesture::kKey, keyOf(letter), true, action};
}
constexpr Control shiftControlKey(char letter, Action action) {
    return {"", "Edit", "", Gesture::kKey, keyOf(letter), true, action, true};
}
constexpr Control flyKey(const char* press, const char* does, char letter, Action action) {
    return {press, "Camera", does, Gesture::kHeldKey, keyOf(letter), false, action};
}

/// Rows of a group must be adjacent.
constexpr Control kControls[] = {
    mouseControl("left drag", "Camera", "orbit about the centre of the view", Gesture::kLeftDrag, Action::kOrbit),
    mouseControl("right drag, Shift + left drag", "Camera", "pan", Gesture::kRightDrag, Action::kPan),
    mouseControl("", "Camera", "", Gesture::kShiftLeftDrag, Action::kPan),
    mouseControl("wheel", "Camera", "zoom to the cursor", Gesture::kWheel, Action::kZoom),
    mouseControl("double click", "Camera", "centre the point under the cursor and orbit about it",
                 Gesture::kDoubleClick, Action::kCentreOn),
    flyKey("W A S D, Q E", "fly forward, left, back, right; down, up; drag to look around", 'W', Action::kFlyForward),
    flyKey("", "", 'A', Action::kFlyLeft),
    flyKey("", "", 'S', Action::kFlyBack),
    flyKey("", "", 'D', Action::kFlyRight),
    flyKey("", "", 'Q', Action::kFlyDown),
    flyKey("", "", 'E', Action::kFlyUp),
    keyControl("Home", "Camera", "return to the initial view", Key::kHome, Action::kHome),
    keyControl("1", "Camera", "view from the front", keyOf('1'), Action::kFrontView),
    keyControl("3", "Camera", "view from the right", keyOf('3'), Action::kRightView),
    keyControl("7", "Camera", "view from the top", keyOf('7'), Action::kTopView),
    keyControl("9", "Camera", "view from the opposite side", keyOf('9'), Action::kOppositeView),
    keyControl("5", "Camera", "switch between orthographic and perspective", keyOf('5'), Action::kOrthographic),
    controlKey("Ctrl + C", "Camera", "copy the camera as `pointrt-view` options", 'C', Action::kCopyCamera),
    controlKey("Ctrl + V", "Camera", "paste a camera", 'V', Action::kPasteCamera),
    keyControl("V", "Camera", "save the view to the panel's list", keyOf('V'), Action::kSaveView),
    keyControl("PageUp, PageDown", "Camera", "go to the previous or next saved view", Key::kPageUp,
               Action::kPreviousView),
    keyControl("", "Camera", "", Key::kPageDown, Action::kNextView),
    mouseControl("click", "Measure", "pick the point under the cursor", Gesture::kClick, Action::kPick),
    keyControl("M", "Measure", "add each pick to a path, for angles and areas; again to clear it", keyOf('M'),
               Action::kMeasurement),
    keyControl("K", "Measure", "keep the measured path with the scene, as a layer", keyOf('K'),
               Action::kKeepMeasurement),
    keyControl("Space", "Picture", "pause or resume", Key::kSpace, Action::kPause),
    keyControl("F12", "Picture", "save the picture as PNG and EXR", Key::kF12, Action::kScreenshot),
    controlKey("Ctrl + S", "Picture", "save the scene to a file for `pointrt-view`", 'S', Action::kSaveScene),
    controlKey("Ctrl + Z", "Edit",
               "undo the last edit of light, materials, surroundings, clips, measurements, settings or views", 'Z',
               Action::kUndo),
    controlKey("Ctrl + Y, Ctrl + Shift + Z", "Edit", "redo it", 'Y', Action::kRedo),
    shiftControlKey('Z', Action::kRedo),
    controlKey("Ctrl + O", "Window", "open scans or a scene", 'O', Action::kOpen),
    controlKey("Ctrl + K", "Window", "search for a command", 'K', Action::kPalette),
    keyControl("Left, Right", "Window", "previous file, next file", Key::kLeft, Action::kPreviousFile),
    keyControl("", "Window", "", Key::kRight, Action::kNextFile),
    keyControl("P, Tab", "Window", "show or hide the panel and the toolbar", keyOf('P'), Action::kPanel),
    keyControl("", "Window", "", Key::kTab, Action::kPanel),
    keyControl("H", "Window", "show or hide this list", keyOf('H'), Action::kCheatSheet),
    keyControl("Esc", "Window", "close an open list or window, or cancel the running job, or clear the picks",
               Key::kEscape, Action::kBack),
    controlKey("Ctrl + Q", "Window", "quit; asks if there are unsaved edits", 'Q', Action::kQuit),
};

/// Finds the control bound to a gesture and, for key presses, to a key with these modifiers (Shift counts only with
/// Ctrl). Null if nothing is bound to it.
const Control* findControl(Gesture gesture, Key key = Key::kUnknown, bool with_control = false,
                           bool with_shift = false);

/// The table in docs/WINDOW.md; lines end in \n.
std::string markdownTable();
/// For terminals: groups, with columns padded by spaces.
std::string helpText();

} // namespace pointrt
