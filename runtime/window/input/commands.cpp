// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/commands.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

using Commands = std::vector<Command>;

bool isHeld(const ControlState& state, Key key) { return state.held.test(static_cast<std::size_t>(key)); }

struct FlyKey {
    Action action;
    Vec3 way;
};
constexpr FlyKey kFlyKeys[] = {{Action::kFlyForward, {0, 0, 1}}, {Action::kFlyBack, {0, 0, -1}},
                               {Action::kFlyRight, {1, 0, 0}},   {Action::kFlyLeft, {-1, 0, 0}},
                               {Action::kFlyUp, {0, 1, 0}},      {Action::kFlyDown, {0, -1, 0}}};

/// With Ctrl, keys do not fly: Ctrl + S saves.
Vec3 heldDirection(const ControlState& state) {
    Vec3 direction;
    if (state.ui_wants_keyboard || isHeld(state, Key::kControl)) return direction;
    for (const Control& control : kControls) {
        if (control.gesture != Gesture::kHeldKey || !isHeld(state, control.key)) continue;
        for (const FlyKey& each : kFlyKeys)
            if (each.action == control.action) direction = direction + each.way;
    }
    return direction;
}

bool isFlying(const ControlState& state) { return !(state.flying == Vec3{}); }

void updateFlight(ControlState& state, Commands& commands) {
    const Vec3 direction = heldDirection(state);
    if (direction == state.flying) return;
    state.flying = direction;
    commands.emplace_back(FlyCommand{direction});
}

Gesture dragGesture(const Drag& drag) {
    if (drag.button == MouseButton::kRight) return Gesture::kRightDrag;
    return drag.with_shift ? Gesture::kShiftLeftDrag : Gesture::kLeftDrag;
}

void dragTo(ControlState& state, Commands& commands) {
    Drag& drag = *state.drag;
    const double dx = state.x - drag.x, dy = state.y - drag.y;
    drag.moving = drag.moving || std::hypot(dx, dy) > kDragThreshold;
    if (!drag.moving || drag.on_ui || drag.button == MouseButton::kMiddle || (dx == 0 && dy == 0)) return;
    drag.x = state.x;
    drag.y = state.y;
    state.last_click.reset();
    const Control* control = findControl(dragGesture(drag));
    if (control == nullptr) return;
    if (control->action == Action::kPan)
        commands.emplace_back(PanCommand{dx, dy});
    else if (isFlying(state))
        commands.emplace_back(LookCommand{dx, dy});
    else
        commands.emplace_back(OrbitCommand{dx, dy});
}

/// Whether a press now completes a double click.
bool endsDoubleClick(const ControlState& state, double time_s) {
    if (!state.last_click) return false;
    const double waited_s = time_s - state.last_click->time_s;
    const double distance = std::hypot(state.x - state.last_click->x, state.y - state.last_click->y);
    return waited_s >= 0 && waited_s <= kDoubleClick_s && distance <= kDoubleClickDistance;
}

void press(ControlState& state, MouseButton button, double time_s, Commands& commands) {
    // a second press of the same button: its release outside the window was lost
    if (state.drag && state.drag->button != button) return;
    Drag drag{button, state.x, state.y};
    drag.with_shift = isHeld(state, Key::kShift);
    drag.on_ui = state.ui_wants_mouse;
    const bool clicks = button == MouseButton::kLeft && !drag.on_ui && !drag.with_shift;
    drag.second_click = clicks && endsDoubleClick(state, time_s);
    if (drag.second_click) commands.emplace_back(CentreCommand{state.x, state.y});
    state.last_click.reset();
    if (clicks && !drag.second_click) state.last_click = ControlState::Click{state.x, state.y, time_s};
    state.drag = drag;
}

void release(ControlState& state, MouseButton button, Commands& commands) {
    if (!state.drag || state.drag->button != button) return;
    const Drag drag = *state.drag;
    state.drag.reset();
    const bool clicked = button == MouseButton::kLeft && !drag.moving && !drag.on_ui && !drag.with_shift;
    if (clicked && !drag.second_click) commands.emplace_back(PickCommand{drag.x, drag.y});
}

struct Interpreter {
    ControlState& state;
    double time_s;
    Commands& commands;

    void operator()(const KeyEvent& event) const {
        const auto index = static_cast<std::size_t>(event.key);
        if (index >= kKeys || event.key == Key::kUnknown) return;
        const bool repeats = event.down && state.held.test(index);
        state.held.set(index, event.down);
        if (!event.down || repeats || state.ui_wants_keyboard) return;
        const Control* control =
            findControl(Gesture::kKey, event.key, isHeld(state, Key::kControl), isHeld(state, Key::kShift));
        if (control != nullptr) commands.emplace_back(control->action);
    }
    void operator()(const TextEvent&) const {}
    void operator()(const ButtonEvent& event) const {
        if (event.down)
            press(state, event.button, time_s, commands);
        else
            release(state, event.button, commands);
    }
    void operator()(const CursorEvent& event) const {
        if (!std::isfinite(event.x) || !std::isfinite(event.y)) return;
        state.x = event.x;
        state.y = event.y;
        if (state.drag) dragTo(state, commands);
    }
    void operator()(const WheelEvent& event) const {
        const bool has_turned = std::isfinite(event.y) && event.y != 0;
        if (!has_turned || state.ui_wants_mouse || findControl(Gesture::kWheel) == nullptr) return;
        const double steps = std::clamp(event.y, -kMaxWheelSteps, kMaxWheelSteps);
        commands.emplace_back(ZoomCommand{steps, state.x, state.y});
    }
    void operator()(const ResizeEvent& event) const { commands.emplace_back(event); }
    void operator()(const DropEvent& event) const {
        if (!event.paths.empty()) commands.emplace_back(event);
    }
    void operator()(const CloseEvent&) const { commands.emplace_back(Action::kQuit); }
};

} // namespace

std::vector<Command> interpret(ControlState& state, const InputEvent& event, double time_s) {
    Commands commands;
    std::visit(Interpreter{state, time_s, commands}, event);
    updateFlight(state, commands);
    return commands;
}

std::vector<Command> releaseAll(ControlState& state) {
    Commands commands;
    state.held.reset();
    state.drag.reset();
    state.last_click.reset();
    updateFlight(state, commands);
    return commands;
}

} // namespace pointrt
