// SPDX-License-Identifier: Apache-2.0
// What keys and drags do to workspace and camera.
#include "runtime/window/edit/actions.h"

#include <gtest/gtest.h>

#include "runtime/window/input/camera_commands.h"
#include "runtime/window/input/view_driver.h"

namespace pointrt {
namespace {

TEST(Actions, AskForWhatTakesMore) {
    Workspace work;
    EXPECT_TRUE(actOn(work, Action::kScreenshot));
    EXPECT_TRUE(actOn(work, Action::kSaveScene));
    EXPECT_TRUE(actOn(work, Action::kSaveView));
    EXPECT_TRUE(work.requests.screenshot && work.requests.save_scene && work.requests.save_view);
    EXPECT_FALSE(work.requests.quit);
    actOn(work, Action::kQuit);
    EXPECT_TRUE(work.requests.quit);
}

TEST(Actions, SwitchOnAndOff) {
    Workspace work;
    for (const bool paused : {true, false}) {
        actOn(work, Action::kPause);
        EXPECT_EQ(work.paused, paused);
    }
    actOn(work, Action::kPanel);
    EXPECT_FALSE(work.show_panel);
    work.picks.resize(2);
    actOn(work, Action::kMeasurement);
    EXPECT_EQ(work.picks.size(), 2u);
    actOn(work, Action::kMeasurement);
    EXPECT_TRUE(work.picks.empty()) << "cleared with the line";
}

TEST(Actions, EscapeGoesBackOneStep) {
    Workspace work;
    work.job.emplace();
    actOn(work, Action::kCheatSheet);
    EXPECT_TRUE(work.show_cheat_sheet);
    actOn(work, Action::kBack);
    EXPECT_FALSE(work.show_cheat_sheet);
    EXPECT_FALSE(work.requests.cancel_job);
    actOn(work, Action::kBack);
    EXPECT_TRUE(work.requests.cancel_job);
    EXPECT_FALSE(work.requests.quit);
    work.job->can_cancel = false;
    actOn(work, Action::kBack);
    EXPECT_TRUE(work.requests.quit);
}

/// Every key of the table is somebody's: the workspace's, the camera's, or the window's own four.
TEST(Actions, NoKeyIsForgotten) {
    const ViewCamera camera;
    for (const Control& control : kControls) {
        if (control.gesture != Gesture::kKey) continue;
        Workspace work;
        const bool own = control.action == Action::kCopyCamera || control.action == Action::kPasteCamera ||
                         control.action == Action::kPreviousFile || control.action == Action::kNextFile;
        EXPECT_EQ(
            int{actOn(work, control.action)} + int{viewAsked(control.action, camera, camera).has_value()} + int{own}, 1)
            << control.press;
    }
}

TEST(CameraCommands, MoveTheCamera) {
    const ViewCamera camera;
    const ViewSize size{200, 100};
    EXPECT_EQ(viewAfter(OrbitCommand{10, 5}, camera, size)->eye, orbited(camera, size, 10, 5).eye);
    EXPECT_EQ(viewAfter(LookCommand{10, 5}, camera, size)->pivot, looked(camera, size, 10, 5).pivot);
    EXPECT_EQ(viewAfter(PanCommand{10, 5}, camera, size)->eye, panned(camera, size, 10, 5).eye);
    EXPECT_EQ(viewAfter(ZoomCommand{2, 10, 5}, camera, size)->eye, zoomed(camera, size, 2, 10, 5).eye);
    EXPECT_FALSE(viewAfter(PickCommand{1, 1}, camera, size));
    EXPECT_FALSE(viewAfter(Action::kHome, camera, size));
}

TEST(CameraCommands, FlyToViews) {
    ViewCamera camera, home;
    home.eye = {3, 0, 0};
    EXPECT_EQ(viewAsked(Action::kHome, camera, home)->eye, home.eye);
    EXPECT_EQ(viewAsked(Action::kTopView, camera, home)->eye, standardView(camera, StandardView::kTop).eye);
    EXPECT_GT(viewAsked(Action::kOrthographic, camera, home)->ortho_height, 0);
    EXPECT_FALSE(viewAsked(Action::kPause, camera, home));
}

TEST(ViewDriver, FliesAndLands) {
    ViewDriver driver;
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

TEST(ViewDriver, GoesWhileKeysAreHeld) {
    ViewDriver driver;
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
