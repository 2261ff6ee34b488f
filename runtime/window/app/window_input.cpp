// SPDX-License-Identifier: Apache-2.0
// What the user does to the window.
#include <imgui.h>

#include <algorithm>

#include "format/base/error.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/window/app/window_state.h"
#include "runtime/window/jobs/file_list.h"
#include "runtime/window/view/camera_text.h"

namespace pointrt {

ViewSize Window::viewSize() const {
    const ResizeEvent size = host_.size();
    return {std::max(1.0, double(size.width)), std::max(1.0, double(size.height))};
}

void Window::handle(const InputEvent& event) {
    const ImGuiIO& io = ImGui::GetIO();
    controls_.ui_wants_mouse = io.WantCaptureMouse;
    controls_.ui_wants_keyboard = io.WantTextInput;
    feedImGui(ui_input_, event);
    if (std::holds_alternative<CloseEvent>(event)) quit_ = true;
    for (const Command& command : interpret(controls_, event, now())) obey(command);
}

void Window::obey(const Command& command) {
    struct {
        Window& window;
        ViewCamera& camera;
        ViewSize size;
        void go(const ViewCamera& view) const {
            window.flight_.reset();
            camera = view;
        }
        void operator()(const OrbitCommand& c) const { go(orbited(camera, size, c.dx, c.dy)); }
        void operator()(const LookCommand& c) const { go(looked(camera, size, c.dx, c.dy)); }
        void operator()(const PanCommand& c) const { go(panned(camera, size, c.dx, c.dy)); }
        void operator()(const ZoomCommand& c) const { go(zoomed(camera, size, c.steps, c.x, c.y)); }
        void operator()(const PickCommand& c) const { window.pick_ = {c.x, c.y, false}; }
        void operator()(const CentreCommand& c) const { window.pick_ = {c.x, c.y, true}; }
        void operator()(const FlyCommand& c) const { window.flying_ = c.direction; }
        void operator()(Action action) const { window.obey(action); }
        void operator()(const DropEvent& drop) const { window.drop(drop.paths); }
        void operator()(const ResizeEvent&) const {}
    } const visitor{*this, work_.camera, viewSize()};
    std::visit(visitor, command);
}

void Window::obey(Action action) {
    Requests& requests = work_.requests;
    switch (action) {
    case Action::kHome:
        return flyTo(home_);
    case Action::kFrontView:
        return flyTo(standardView(work_.camera, StandardView::kFront));
    case Action::kRightView:
        return flyTo(standardView(work_.camera, StandardView::kRight));
    case Action::kTopView:
        return flyTo(standardView(work_.camera, StandardView::kTop));
    case Action::kOppositeView:
        return flyTo(oppositeView(work_.camera));
    case Action::kOrthographic:
        return flyTo(orthoToggled(work_.camera));
    case Action::kCopyCamera:
        return host_.setClipboard(cameraText(work_.camera));
    case Action::kPasteCamera:
        try {
            return flyTo(withCameraText(work_.camera, host_.clipboard()));
        } catch (const Error& error) {
            return tell(error.what(), true);
        }
    case Action::kSaveView:
        requests.save_view = true;
        return;
    case Action::kMeasurement:
        work_.keeps_measurement = !work_.keeps_measurement;
        if (!work_.keeps_measurement) work_.picks.clear();
        return;
    case Action::kPause:
        work_.paused = !work_.paused;
        return;
    case Action::kScreenshot:
        requests.screenshot = true;
        return;
    case Action::kSaveScene:
        requests.save_scene = true;
        return;
    case Action::kPreviousFile:
        return stepFile(-1);
    case Action::kNextFile:
        return stepFile(1);
    case Action::kPanel:
        work_.show_panel = !work_.show_panel;
        return;
    case Action::kCheatSheet:
        work_.show_cheat_sheet = !work_.show_cheat_sheet;
        return;
    case Action::kBack:
        if (work_.show_cheat_sheet)
            work_.show_cheat_sheet = false;
        else if (work_.job && work_.job->can_cancel)
            requests.cancel_job = true;
        else
            quit_ = true;
        return;
    case Action::kQuit:
        quit_ = true;
        return;
    default:
        return; // those that come with numbers
    }
}

void Window::flyTo(const ViewCamera& view) { flight_ = ViewFlight{work_.camera, view, now()}; }

void Window::moveCamera(double seconds) {
    if (flight_) {
        work_.camera = viewAt(*flight_, now());
        if (hasLanded(*flight_, now())) flight_.reset();
    }
    if (length(flying_) > 0) work_.camera = flown(work_.camera, flying_, std::min(seconds, 0.1));
}

void Window::goToView(const NamedView& view) {
    try {
        const ViewSize size = viewSize();
        flyTo(framedView(view.camera, work_.scene_min, work_.scene_max, sceneUp(work_.scene, work_.settings),
                         size.width / size.height));
    } catch (const Error& error) {
        tell(view.name + ": " + error.what(), true);
    }
}

void Window::stepFile(int step) {
    const std::string path = neighbourFile(work_.scene.path, step);
    if (!path.empty() && path != work_.scene.path) open(path);
}

} // namespace pointrt
