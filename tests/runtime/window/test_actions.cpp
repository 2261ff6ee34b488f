// SPDX-License-Identifier: Apache-2.0
// Effects of actions and drags on the workspace and the camera.
#include "runtime/window/edit/actions.h"

#include <gtest/gtest.h>

#include "runtime/window/input/camera_commands.h"
#include "runtime/window/input/view_animator.h"

namespace pointrt {
namespace {

TEST(Actions, SetRequestsForTheWindow) {
    Workspace work;
    EXPECT_TRUE(applyAction(work, Action::kScreenshot));
    EXPECT_TRUE(applyAction(work, Action::kSaveScene));
    EXPECT_TRUE(applyAction(work, Action::kSaveView));
    EXPECT_TRUE(work.requests.screenshot && work.requests.save_scene && work.requests.save_view);
    EXPECT_FALSE(work.requests.quit);
    applyAction(work, Action::kQuit);
    EXPECT_TRUE(work.requests.quit);
}

TEST(Actions, ToggleState) {
    Workspace work;
    for (const bool paused : {true, false}) {
        applyAction(work, Action::kPause);
        EXPECT_EQ(work.paused, paused);
    }
    applyAction(work, Action::kPanel);
    EXPECT_FALSE(work.show_panel);
    work.picks.resize(2);
    applyAction(work, Action::kMeasurement);
    EXPECT_EQ(work.picks.size(), 2u);
    applyAction(work, Action::kMeasurement);
    EXPECT_TRUE(work.picks.empty()) << "cleared with the line";
}

TEST(Actions, EscapeGoesBackButNeverQuits) {
    Workspace work;
    work.job.emplace();
    work.picks.resize(1);
    work.question = Question{"Save?", {"Save", "Discard", "Cancel"}};
    applyAction(work, Action::kCheatSheet);
    EXPECT_TRUE(work.show_cheat_sheet);
    applyAction(work, Action::kBack);
    EXPECT_EQ(work.requests.answer, 2u);
    work.question.reset();
    applyAction(work, Action::kBack);
    EXPECT_FALSE(work.show_cheat_sheet);
    EXPECT_FALSE(work.requests.cancel_job);
    applyAction(work, Action::kBack);
    EXPECT_TRUE(work.requests.cancel_job);
    work.job->can_cancel = false;
    EXPECT_EQ(work.picks.size(), 1u);
    applyAction(work, Action::kBack);
    EXPECT_TRUE(work.picks.empty());
    applyAction(work, Action::kBack);
    EXPECT_FALSE(work.requests.quit);
}

TEST(Actions, UndoAndRedoHaveTheirUsualKeys) {
    EXPECT_EQ(findControl(Gesture::kKey, keyOf('Z'), true)->action, Action::kUndo);
    EXPECT_EQ(findControl(Gesture::kKey, keyOf('Z'), true, true)->action, Action::kRedo);
    EXPECT_EQ(findControl(Gesture::kKey, keyOf('Y'), true)->action, Action::kRedo);
    EXPECT_EQ(findControl(Gesture::kKey, keyOf('7'), false, true)->action, Action::kTopView)
        << "Shift changes no other";
}

TEST(Actions, SavedViewsAreShownInTurn) {
    Workspace work;
    applyAction(work, Action::kNextView);
    EXPECT_FALSE(work.requests.go_to_view) << "no view is saved";
    work.scene.views = {{"a", {}}, {"b", {}}, {"c", {}}};
    std::vector<std::size_t> shown;
    for (const Action action : {Action::kNextView, Action::kNextView, Action::kNextView, Action::kNextView,
                                Action::kPreviousView, Action::kPreviousView}) {
        applyAction(work, action);
        shown.push_back(work.requests.go_to_view.value());
    }
    EXPECT_EQ(shown, (std::vector<std::size_t>{0, 1, 2, 0, 2, 1}));
    work.scene.views.resize(1); // deleted meanwhile
    applyAction(work, Action::kPreviousView);
    EXPECT_EQ(work.requests.go_to_view, 0u);
}

/// Every action is handled by the workspace, the camera, or the window (four of them).
TEST(Actions, EveryKeyIsHandled) {
    const ViewCamera camera;
    for (const Control& control : kControls) {
        if (control.gesture != Gesture::kKey) continue;
        Workspace work;
        const bool own = control.action == Action::kCopyCamera || control.action == Action::kPasteCamera ||
                         control.action == Action::kPreviousFile || control.action == Action::kNextFile;
        EXPECT_EQ(int{applyAction(work, control.action)} +
                      int{cameraForAction(control.action, camera, camera, ViewSize{}).has_value()} + int{own},
                  1)
            << control.press;
    }
}

TEST(CameraCommands, MoveTheCamera) {
    const ViewCamera camera;
    const ViewSize size{200, 100};
    EXPECT_EQ(cameraAfter(OrbitCommand{10, 5}, camera, size)->eye, orbited(camera, size, 10, 5).eye);
    EXPECT_EQ(cameraAfter(LookCommand{10, 5}, camera, size)->pivot, looked(camera, size, 10, 5).pivot);
    EXPECT_EQ(cameraAfter(PanCommand{10, 5}, camera, size)->eye, panned(camera, size, 10, 5).eye);
    EXPECT_EQ(cameraAfter(ZoomCommand{2, 10, 5}, camera, size)->eye, zoomed(camera, size, 2, 10, 5).eye);
    EXPECT_FALSE(cameraAfter(PickCommand{1, 1}, camera, size));
    EXPECT_FALSE(cameraAfter(Action::kHome, camera, size));
}

TEST(CameraCommands, FlyToViews) {
    ViewCamera camera, home;
    const ViewSize size{200, 100};
    home.eye = {3, 0, 0};
    EXPECT_EQ(cameraForAction(Action::kHome, camera, home, size)->eye, home.eye);
    EXPECT_EQ(cameraForAction(Action::kTopView, camera, home, size)->eye,
              fittedView(standardView(camera, StandardView::kTop), size).eye);
    EXPECT_GT(cameraForAction(Action::kOrthographic, camera, home, size)->ortho_height, 0);
    EXPECT_FALSE(cameraForAction(Action::kPause, camera, home, size));
}

TEST(ViewAnimator, FliesToAView) {
    ViewAnimator driver;
    ViewCamera from, to;
    to.eye = {2, 0, 0};
    EXPECT_FALSE(driver.moves());
    EXPECT_EQ(driver.advanced(from, 5, 0.1).eye, from.eye);
    driver.flyTo(from, to, 5);
    EXPECT_TRUE(driver.moves() && driver.isInFlight());
    EXPECT_NE(driver.advanced(from, 5.1, 0.1).eye, from.eye);
    EXPECT_EQ(driver.advanced(from, 6, 0.1).eye, to.eye);
    EXPECT_FALSE(driver.moves());
    driver.flyTo(from, to, 7);
    driver.stop();
    EXPECT_EQ(driver.advanced(from, 7.1, 0.1).eye, from.eye);
}

TEST(ViewAnimator, MovesWhileKeysAreHeld) {
    ViewAnimator driver;
    const ViewCamera camera;
    driver.flyAlong({1, 0, 0});
    EXPECT_TRUE(driver.moves());
    EXPECT_FALSE(driver.isInFlight());
    EXPECT_EQ(driver.advanced(camera, 0, 0.05).eye, flown(camera, {1, 0, 0}, 0.05).eye);
    EXPECT_EQ(driver.advanced(camera, 0, 9).eye, flown(camera, {1, 0, 0}, 0.1).eye) << "after a frame that took long";
    driver.flyAlong({});
    EXPECT_FALSE(driver.moves());
}

} // namespace
} // namespace pointrt
