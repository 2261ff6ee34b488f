// SPDX-License-Identifier: Apache-2.0
// Translates input events to commands, using the table of controls.h.
#pragma once

#include <bitset>
#include <optional>
#include <variant>
#include <vector>

#include "runtime/util/vec.h"
#include "runtime/window/input/controls.h"
#include "runtime/window/input/events.h"

namespace pointrt {

/// Lengths and positions in window units, y down, as in CursorEvent.
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
/// steps: positive zooms in.
struct ZoomCommand {
    double steps = 0, x = 0, y = 0;
};
struct PickCommand {
    double x = 0, y = 0;
};
struct CentreCommand {
    double x = 0, y = 0;
};
/// Sets the direction of flight until the next FlyCommand: x right, y up, z forward, each -1, 0 or 1.
struct FlyCommand {
    Vec3 direction;
};

/// An Action is a command that takes effect at once.
using Command = std::variant<OrbitCommand, LookCommand, PanCommand, ZoomCommand, PickCommand, CentreCommand, FlyCommand,
                             Action, DropEvent, ResizeEvent>;

constexpr double kDoubleClick_s = 0.4;     // between two presses
constexpr double kDoubleClickDistance = 4; // between two presses, window units
constexpr double kDragThreshold = 3;       // from the press, window units: hands tremble
constexpr double kMaxWheelSteps = 100;     // in one event; some drivers merge a second's worth
constexpr std::size_t kKeys = 512;         // more than the values of Key

/// A button that is held, and what dragging it does.
struct Drag {
    MouseButton button = MouseButton::kLeft;
    double x = 0, y = 0; ///< position of the press, then of the last movement that made a command
    bool with_shift = false;
    bool moving = false;       ///< past the threshold
    bool on_ui = false;        ///< started on a panel: ignored here
    bool second_click = false; ///< the press completed a double click, which has centred the view
};

struct ControlState {
    /// Set these from Dear ImGui's flags before each event. A drag belongs to the place where it started.
    bool ui_wants_mouse = false, ui_wants_keyboard = false;

    double x = 0, y = 0; ///< cursor position
    std::bitset<kKeys> held;
    std::optional<Drag> drag; ///< one at a time: other buttons are ignored meanwhile
    struct Click {
        double x = 0, y = 0, time_s = 0;
    };
    std::optional<Click> last_click; ///< candidate for a double click
    Vec3 flying;                     ///< direction of the last FlyCommand
};

/// The commands for event at time_s, in seconds of any steady clock. Key repeats are ignored.
std::vector<Command> interpret(ControlState& state, const InputEvent& event, double time_s);

/// Call it when the window loses the keyboard focus or a dialogue has taken events. Releases all keys and buttons:
/// flying stops, and a pending press is not a click.
std::vector<Command> releaseAll(ControlState& state);

} // namespace pointrt
