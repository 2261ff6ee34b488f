// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/actions.h"

namespace pointrt {
namespace {

void toggleMeasurement(Workspace& work) {
    work.pin_measurement = !work.pin_measurement;
    if (!work.pin_measurement) work.picks.clear();
}

void goBack(Workspace& work) {
    if (work.question)
        work.requests.answer = work.question->answers.size() - 1;
    else if (work.show_palette)
        work.show_palette = false;
    else if (work.browser)
        work.browser.reset();
    else if (work.show_cheat_sheet)
        work.show_cheat_sheet = false;
    else if (work.job && work.job->can_cancel)
        work.requests.cancel_job = true;
    else
        work.picks.clear();
}

/// Moves by steps in the list of views, cyclically.
void goToView(Workspace& work, std::size_t steps) {
    const std::size_t count = work.scene.views.size();
    if (count == 0) return;
    if (!work.shown_view || *work.shown_view >= count)
        work.shown_view = steps == 1 ? 0 : count - 1;
    else
        work.shown_view = (*work.shown_view + steps) % count;
    work.requests.go_to_view = work.shown_view;
}

constexpr struct {
    Action action;
    void (*act)(Workspace&);
} kActionHandlers[] = {
    {Action::kSaveView, [](Workspace& w) { w.requests.save_view = true; }},
    {Action::kNextView, [](Workspace& w) { goToView(w, 1); }},
    {Action::kPreviousView, [](Workspace& w) { goToView(w, w.scene.views.size() - 1); }},
    {Action::kMeasurement, toggleMeasurement},
    {Action::kKeepMeasurement, [](Workspace& w) { w.requests.keep_measurement = true; }},
    {Action::kPause, [](Workspace& w) { w.paused = !w.paused; }},
    {Action::kScreenshot, [](Workspace& w) { w.requests.screenshot = true; }},
    {Action::kSaveScene, [](Workspace& w) { w.requests.save_scene = true; }},
    {Action::kOpen, [](Workspace& w) { w.requests.open = true; }},
    {Action::kPalette, [](Workspace& w) { w.show_palette = !w.show_palette; }},
    {Action::kPanel, [](Workspace& w) { w.show_panel = !w.show_panel; }},
    {Action::kCheatSheet, [](Workspace& w) { w.show_cheat_sheet = !w.show_cheat_sheet; }},
    {Action::kUndo, [](Workspace& w) { w.requests.undo = true; }},
    {Action::kRedo, [](Workspace& w) { w.requests.redo = true; }},
    {Action::kBack, goBack},
    {Action::kQuit, [](Workspace& w) { w.requests.quit = true; }},
};

} // namespace

bool applyAction(Workspace& work, Action action) {
    for (const auto& each : kActionHandlers)
        if (each.action == action) {
            each.act(work);
            return true;
        }
    return false;
}

} // namespace pointrt
