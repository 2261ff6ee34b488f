// SPDX-License-Identifier: Apache-2.0
// Settings that the window keeps from run to run, and names of stills.
#include "runtime/window/edit/preferences.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "runtime/window/edit/still_job.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

TEST(Preferences, AreKept) {
    const test::TemporaryFolder folder;
    Workspace before;
    before.light_theme = true;
    before.show_hud = false;
    before.open_sections = {{"Light", false}, {"Clip", true}};
    writePreferences(folder.file("state"), before);
    Workspace after;
    readPreferences(folder.file("state"), after);
    EXPECT_TRUE(after.light_theme);
    EXPECT_FALSE(after.show_hud);
    EXPECT_TRUE(after.show_panel);
    EXPECT_EQ(after.open_sections, before.open_sections);
}

TEST(Preferences, IgnoreOtherLines) {
    const test::TemporaryFolder folder;
    std::ofstream(folder.file("window"))
        << "on light theme of another version\n\non\nlight theme\non panel\nOFF panel\n"
        << std::string(100000, 'x') << "\noff statistics";
    Workspace work;
    readPreferences(folder.path.string(), work);
    EXPECT_FALSE(work.light_theme);
    EXPECT_TRUE(work.show_panel);
    EXPECT_FALSE(work.show_hud);
    readPreferences("", work); // no folder
    readPreferences(folder.file("missing"), work);
}

TEST(Stills, HaveNamesOfTheirOwn) {
    const test::TemporaryFolder folder;
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path);
    std::ofstream("statue-still-1.png") << "x";
    EXPECT_EQ(freeStillName("scans/statue.ply", {}), "statue-still-2.png");
    EXPECT_EQ(freeStillName("statue.ply", {Still{{}, {}, "statue-still-2.png"}}), "statue-still-3.png");
    std::filesystem::current_path(before);
}

} // namespace
} // namespace pointrt
