// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/controls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <string_view>

#include "runtime/window/input/commands.h"

namespace pointrt {
namespace {

/// A command as text, to compare: its name and numbers.
struct CommandText {
    static std::string number(double value) {
        std::ostringstream text;
        text << " " << value;
        return text.str();
    }
    std::string operator()(const OrbitCommand& c) const { return "orbit" + number(c.dx) + number(c.dy); }
    std::string operator()(const LookCommand& c) const { return "look" + number(c.dx) + number(c.dy); }
    std::string operator()(const PanCommand& c) const { return "pan" + number(c.dx) + number(c.dy); }
    std::string operator()(const ZoomCommand& c) const { return "zoom" + number(c.steps) + number(c.x) + number(c.y); }
    std::string operator()(const PickCommand& c) const { return "pick" + number(c.x) + number(c.y); }
    std::string operator()(const CentreCommand& c) const { return "centre" + number(c.x) + number(c.y); }
    std::string operator()(const FlyCommand& c) const {
        return "fly" + number(c.direction.x) + number(c.direction.y) + number(c.direction.z);
    }
    std::string operator()(Action action) const { return "action" + number(static_cast<int>(action)); }
    std::string operator()(const DropEvent& c) const { return "drop" + number(static_cast<double>(c.paths.size())); }
    std::string operator()(const ResizeEvent& c) const { return "resize" + number(c.width) + number(c.height); }
};

std::string text(const std::vector<Command>& commands) {
    std::string joined;
    for (const Command& command : commands) joined += (joined.empty() ? "" : "; ") + std::visit(CommandText{}, command);
    return joined;
}

/// Sends input events; each call returns the commands as text.
struct User {
    ControlState state;
    double time_s = 0;

    std::string send(const InputEvent& event) { return text(interpret(state, event, time_s)); }
    std::string move(double x, double y) { return send(CursorEvent{x, y}); }
    std::string press(MouseButton button = MouseButton::kLeft) { return send(ButtonEvent{button, true}); }
    std::string release(MouseButton button = MouseButton::kLeft) { return send(ButtonEvent{button, false}); }
    std::string down(Key key) { return send(KeyEvent{key, true}); }
    std::string up(Key key) { return send(KeyEvent{key, false}); }
    std::string down(char key) { return down(keyOf(key)); }
    std::string up(char key) { return up(keyOf(key)); }
};

std::string textOf(Action action) { return text({Command{action}}); }

TEST(Controls, DocsMatchTheTable) {
    std::ifstream file(POINTRT_WINDOW_DOC);
    const std::string doc{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(doc.find("\n" + markdownTable()), std::string::npos) << "docs/WINDOW.md should have\n" << markdownTable();
}

TEST(Controls, RowsAreCompleteAndUnique) {
    std::set<std::tuple<Gesture, Key, bool, bool>> seen;
    std::set<std::string_view> groups;
    std::string_view group;
    std::set<Action> shown;
    for (const Control& control : kControls) {
        EXPECT_TRUE(seen.insert({control.gesture, control.key, control.with_control, control.with_shift}).second)
            << control.press;
        const bool by_key = control.gesture == Gesture::kKey || control.gesture == Gesture::kHeldKey;
        EXPECT_EQ(by_key, control.key != Key::kUnknown);
        if (*control.press == '\0') continue;
        EXPECT_NE(std::string_view(control.does), "");
        EXPECT_EQ(std::string(control.does).find('|'), std::string::npos);
        EXPECT_TRUE(shown.insert(control.action).second) << control.press;
        EXPECT_TRUE(group == control.group || groups.insert(control.group).second) << control.group;
        group = control.group;
    }
}

TEST(Controls, EveryActionIsInTheTable) {
    std::set<Action> listed;
    for (const Control& control : kControls) listed.insert(control.action);
    EXPECT_EQ(listed.size(), static_cast<std::size_t>(Action::kQuit) + 1);
}

TEST(Controls, HelpHasALinePerVisibleRow) {
    const std::string help = helpText();
    std::size_t rows = 0;
    for (const Control& control : kControls)
        if (*control.press != '\0') {
            ++rows;
            EXPECT_NE(help.find("\n  " + std::string(control.press) + "  "), std::string::npos) << control.press;
        }
    std::size_t indented = 0;
    for (std::size_t at = help.find("\n  "); at != std::string::npos; at = help.find("\n  ", at + 1)) ++indented;
    EXPECT_EQ(indented, rows);
    EXPECT_EQ(help.find('`'), std::string::npos);
}

TEST(Commands, KeysOfTheTableSendTheirAction) {
    for (const Control& control : kControls) {
        if (control.gesture != Gesture::kKey) continue;
        User user;
        if (control.with_control) user.down(Key::kControl);
        if (control.with_shift) user.down(Key::kShift);
        EXPECT_EQ(user.down(control.key), textOf(control.action)) << control.press;
        EXPECT_EQ(user.down(control.key), "") << "repeated";
        EXPECT_EQ(user.up(control.key), "");
        EXPECT_EQ(user.down(control.key), textOf(control.action)) << "again";
        user.state.ui_wants_keyboard = true;
        user.up(control.key);
        EXPECT_EQ(user.down(control.key), "") << "typed into a field";
    }
}

TEST(Commands, CtrlIsTrackedAcrossKeys) {
    User user;
    EXPECT_EQ(user.down('V'), textOf(Action::kSaveView));
    user.up('V');
    user.down(Key::kControl);
    EXPECT_EQ(user.down('V'), textOf(Action::kPasteCamera));
    user.up('V');
    EXPECT_EQ(user.down('M'), "");
    EXPECT_EQ(user.down('S'), textOf(Action::kSaveScene)); // the key does not also fly
    user.up('S');
    user.up(Key::kControl);
    EXPECT_EQ(user.down('S'), "fly 0 0 -1");
}

TEST(Commands, ClicksPick_DragsOrbit) {
    User user;
    user.move(100, 200);
    EXPECT_EQ(user.press(), "");
    EXPECT_EQ(user.move(102, 202), ""); // below the threshold
    EXPECT_EQ(user.release(), "pick 100 200");

    user.time_s = 5;
    user.press();
    EXPECT_EQ(user.move(106, 202), "orbit 4 0"); // the whole distance since the press
    EXPECT_EQ(user.move(106, 202), "");
    EXPECT_EQ(user.move(105, 200), "orbit -1 -2"); // after that, every unit counts
    EXPECT_EQ(user.release(), "");
    EXPECT_EQ(user.move(300, 300), "");
}

TEST(Commands, RightAndShiftedDragsPan) {
    User user;
    user.move(10, 10);
    user.press(MouseButton::kRight);
    EXPECT_EQ(user.move(20, 10), "pan 10 0");
    EXPECT_EQ(user.release(MouseButton::kRight), "");
    user.down(Key::kShift);
    user.press();
    EXPECT_EQ(user.move(20, 30), "pan 0 20");
    user.up(Key::kShift); // a drag keeps its kind
    EXPECT_EQ(user.move(21, 30), "pan 1 0");
    EXPECT_EQ(user.release(), "");
    user.press(MouseButton::kMiddle);
    EXPECT_EQ(user.move(90, 90), "");
    EXPECT_EQ(user.release(MouseButton::kMiddle), "");
    user.press(MouseButton::kRight);
    EXPECT_EQ(user.release(MouseButton::kRight), ""); // a drag is not a pick
}

TEST(Commands, OneDragAtATime) {
    User user;
    user.press();
    EXPECT_EQ(user.press(MouseButton::kRight), "");
    EXPECT_EQ(user.move(10, 0), "orbit 10 0");
    EXPECT_EQ(user.release(MouseButton::kRight), "");
    EXPECT_EQ(user.move(20, 0), "orbit 10 0");
    EXPECT_EQ(user.release(), "");
}

TEST(Commands, DoubleClickCentres) {
    User user;
    user.move(50, 50);
    user.time_s = 1;
    user.press();
    EXPECT_EQ(user.release(), "pick 50 50");
    user.time_s = 1.39;
    user.move(53, 52);
    EXPECT_EQ(user.press(), "centre 53 52");
    EXPECT_EQ(user.release(), ""); // no second pick
    user.time_s = 1.5;
    EXPECT_EQ(user.press(), ""); // the third click counts as a first one
    EXPECT_EQ(user.release(), "pick 53 52");
}

TEST(Commands, LateFarOrDraggedClicksAreNotDouble) {
    const auto second = [](double later_s, double dx, double drag) {
        User user;
        user.press();
        user.move(drag, 0);
        user.move(0, 0);
        user.release();
        user.time_s = later_s;
        user.move(dx, 0);
        return user.press();
    };
    EXPECT_EQ(second(0.3, 0, 0), "centre 0 0");
    EXPECT_EQ(second(0.41, 0, 0), "");
    EXPECT_EQ(second(0.3, 5, 0), "");
    EXPECT_EQ(second(0.3, 0, 20), "");
    EXPECT_EQ(second(-1, 0, 0), ""); // a clock that runs backwards
}

TEST(Commands, DragsBelongToTheirStart) {
    User user;
    user.state.ui_wants_mouse = true;
    user.press();
    user.state.ui_wants_mouse = false; // the cursor has left the panel
    EXPECT_EQ(user.move(500, 10), "");
    EXPECT_EQ(user.release(), "");
    user.press();
    user.state.ui_wants_mouse = true; // and enters it
    EXPECT_EQ(user.move(510, 10), "orbit 10 0");
    EXPECT_EQ(user.send(WheelEvent{0, 1}), "");
    EXPECT_EQ(user.release(), "");
    EXPECT_EQ(user.press() + user.release(), ""); // a click on the panel
    user.state.ui_wants_mouse = false;
    EXPECT_EQ(user.press(), ""); // not the second of two on the picture
}

TEST(Commands, LostReleaseEndsTheDrag) {
    User user;
    user.press();
    user.move(100, 0);
    user.move(50, 50);
    user.time_s = 3;
    EXPECT_EQ(user.press(), "");
    EXPECT_EQ(user.move(50, 60), "orbit 0 10"); // counted from the new press
    EXPECT_EQ(text(releaseAll(user.state)), "");
    EXPECT_EQ(user.move(90, 90), "");
    EXPECT_EQ(user.release(), "");
    user.press();
    releaseAll(user.state);
    EXPECT_EQ(user.release(), ""); // a drag is not a click
}

TEST(Commands, WheelZoomsToTheCursor) {
    User user;
    user.move(7, 8);
    EXPECT_EQ(user.send(WheelEvent{3, -1.5}), "zoom -1.5 7 8");
    EXPECT_EQ(user.send(WheelEvent{3, 0}), "");
    EXPECT_EQ(user.send(WheelEvent{0, 1e300}), "zoom 100 7 8");
}

TEST(Commands, FliesWhileKeysAreHeld) {
    User user;
    EXPECT_EQ(user.down('W'), "fly 0 0 1");
    EXPECT_EQ(user.down('W'), ""); // repeat
    EXPECT_EQ(user.down('D'), "fly 1 0 1");
    EXPECT_EQ(user.down('A'), "fly 0 0 1"); // they cancel out
    EXPECT_EQ(user.up('A'), "fly 1 0 1");
    EXPECT_EQ(user.up('W'), "fly 1 0 0");
    EXPECT_EQ(user.down('E'), "fly 1 1 0");
    user.press();
    EXPECT_EQ(user.move(10, 0), "look 10 0");
    EXPECT_EQ(user.up('D'), "fly 0 1 0");
    EXPECT_EQ(user.up('E'), "fly 0 0 0");
    EXPECT_EQ(user.move(20, 0), "orbit 10 0");
    EXPECT_EQ(user.down('Q'), "fly 0 -1 0");
    EXPECT_EQ(text(releaseAll(user.state)), "fly 0 0 0");
}

TEST(Commands, TypingStopsFlying) {
    User user;
    user.down('W');
    user.state.ui_wants_keyboard = true;
    EXPECT_EQ(user.down('W'), "fly 0 0 0");
    EXPECT_EQ(user.up('W'), "");
    user.state.ui_wants_keyboard = false;
    EXPECT_EQ(user.move(1, 1), "");
}

TEST(Commands, DropsResizesAndCloseIgnoreThePanels) {
    User user;
    user.state.ui_wants_mouse = user.state.ui_wants_keyboard = true;
    EXPECT_EQ(user.send(DropEvent{{"a.pro", "b.pro"}}), "drop 2");
    EXPECT_EQ(user.send(DropEvent{}), "");
    EXPECT_EQ(user.send(ResizeEvent{640, 480, 2}), "resize 640 480");
    EXPECT_EQ(user.send(CloseEvent{}), textOf(Action::kQuit));
    EXPECT_EQ(user.send(TextEvent{'w'}), "");
}

InputEvent randomEvent(std::mt19937& random) {
    const double numbers[] = {0, 1, -5, 640, 1e300, std::nan(""), std::numeric_limits<double>::infinity()};
    const auto number = [&] { return numbers[random() % 7]; };
    switch (random() % 6) {
    case 0:
        return KeyEvent{static_cast<Key>(random() % 3 ? random() % 300 : random()), random() % 2 == 0};
    case 1:
        return ButtonEvent{static_cast<MouseButton>(random() % 5), random() % 2 == 0};
    case 2:
        return CursorEvent{number(), number()};
    case 3:
        return WheelEvent{number(), number()};
    case 4:
        return ResizeEvent{static_cast<std::uint32_t>(random()), 0, number()};
    default:
        return TextEvent{static_cast<std::uint32_t>(random())};
    }
}

TEST(Commands, RandomEventsAreSafe) {
    std::mt19937 random(4);
    ControlState state;
    for (int i = 0; i < 20000; ++i) {
        state.ui_wants_mouse = random() % 8 == 0;
        state.ui_wants_keyboard = random() % 8 == 0;
        for (const Command& command : interpret(state, randomEvent(random), i * 0.01))
            EXPECT_EQ(std::visit(CommandText{}, command).find("nan"), std::string::npos);
    }
    releaseAll(state);
    EXPECT_TRUE(state.held.none());
}

} // namespace
} // namespace pointrt
