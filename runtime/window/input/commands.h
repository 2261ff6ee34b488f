// SPDX-License-Identifier: Apache-2.0
// From what the user does to what is meant: drags, clicks and keys as commands, by the table of controls.h.
#pragma once

#include <bitset>
#include <optional>
#include <variant>
#include <vector>

#include "runtime/util/vec.h"
#include "runtime/window/input/controls.h"
#include "runtime/window/input/events.h"

namespace pointrt {

/// Lengths and places in window units, y down, as CursorEvent has them.
struct OrbitCommand {
    double dx = 0, dy = 0;
};
/// A drag while a fly key is held.
struct LookCommand {
    double dx = 0, dy = 0;
};
struct PanCommand {
    double dx = 0, dy = 0;
};
/// steps above 0: nearer.
struct ZoomCommand {
    double steps = 0, x = 0, y = 0;
};
struct PickCommand {
    double x = 0, y = 0;
};
struct CentreCommand {
    double x = 0, y = 0;
};
/// From now on until the next one: x right, y up, z ahead, each -1, 0 or 1.
struct FlyCommand {
    Vec3 direction;
};

/// An Action is one of those that happen at once.
using Command = std::variant<OrbitCommand, LookCommand, PanCommand, ZoomCommand, PickCommand, CentreCommand, FlyCommand,
                             Action, DropEvent, ResizeEvent>;

constexpr double kDoubleClick_s = 0.4;     // between the two presses
constexpr double kDoubleClickDistance = 4; // window units between them
constexpr double kDragThreshold = 3;       // window units from the press: a hand is not that still
constexpr double kMaxWheelSteps = 100;     // in one event; some drivers send the turns of a second at once
constexpr std::size_t kKeys = 512;         // more than Key names

/// Where a button went down, and what it does until it goes up.
struct Drag {
    MouseButton button = MouseButton::kLeft;
    double x = 0, y = 0; ///< of the press, then of the last move that counted
    bool with_shift = false;
    bool moving = false;       ///< past the threshold
    bool on_ui = false;        ///< began on the panel: none of ours
    bool second_click = false; ///< has centred already
};

struct ControlState {
    /// To be set before each event, as Dear ImGui says. Drags keep the owner they began with.
    bool ui_wants_mouse = false, ui_wants_keyboard = false;

    double x = 0, y = 0; ///< of the cursor
    std::bitset<kKeys> held;
    std::optional<Drag> drag; ///< one at a time: a second button is nobody's meanwhile
    struct Click {
        double x = 0, y = 0, time_s = 0;
    };
    std::optional<Click> last_click; ///< which another one makes double
    Vec3 flying;                     ///< as the last FlyCommand had it
};

/// What event, at time_s of any steady clock, means after those before it. Keys that repeat do nothing again.
std::vector<Command> interpret(ControlState& state, const InputEvent& event, double time_s);

/// To be called when the window loses the keyboard, or a dialogue took its events: nothing is held or dragged any more.
/// Flying ends; a press without its release is no click.
std::vector<Command> releaseAll(ControlState& state);

} // namespace pointrt
