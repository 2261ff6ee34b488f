// SPDX-License-Identifier: Apache-2.0
// Choosing files to open: the desktop's dialog, and the browser.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "format/os/program.h"
#include "runtime/window/edit/file_browser.h"
#include "runtime/window/edit/file_dialog.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// A script used instead of a dialog.
std::string script(const test::TemporaryFolder& folder, const std::string& name, const std::string& lines) {
    const std::string path = folder.write(name, "#!/bin/sh\n" + lines);
    fs::permissions(path, fs::perms::owner_all);
    return path;
}

std::vector<std::string> resultOf(FileDialog& dialog) {
    for (int wait = 0; wait < 1000; ++wait) {
        if (auto chosen = dialog.result()) return *chosen;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "the dialog stays open";
    return {};
}

TEST(FileDialog, IsTheDesktopsOwn) {
    const test::TemporaryFolder folder;
    const std::string here = fs::path(folder.file("x")).parent_path().string();
    EXPECT_TRUE(dialogCommand("/scans", here, "GNOME").empty()) << "none is installed";
    const std::string kdialog = script(folder, "kdialog", "");
    EXPECT_EQ(dialogCommand("/scans", here, "GNOME").front(), kdialog);
    const std::string zenity = script(folder, "zenity", "");
    EXPECT_EQ(dialogCommand("/scans", here, "GNOME").front(), zenity);
    EXPECT_EQ(dialogCommand("/scans", here, "ubuntu:KDE").front(), kdialog);
    EXPECT_EQ(dialogCommand("/scans", here, "GNOME").back(), "--filename=/scans/");
}

TEST(FileDialog, ReturnsWhatTheUserChooses) {
    const test::TemporaryFolder folder;
    FileDialog chosen({script(folder, "two", "echo 'Gtk-WARNING: theme' >&2\necho '/a b.laz'\necho /c.e57\n")});
    EXPECT_EQ(resultOf(chosen), (std::vector<std::string>{"/a b.laz", "/c.e57"}));
    FileDialog cancelled({script(folder, "none", "echo /a.laz\nexit 1\n")});
    EXPECT_TRUE(resultOf(cancelled).empty());
}

TEST(FileBrowser, ListsFoldersThenFiles) {
    const test::TemporaryFolder folder;
    folder.write("scan10.laz", "");
    folder.write("scan2.laz", "");
    folder.write(".hidden", "");
    folder.write("Photo.JPG", "");
    fs::create_directories(folder.file("tower"));
    fs::create_directories(folder.file("nave.proset"));
    FileBrowser browser = browse(fs::path(folder.file("x")).parent_path().string());
    ASSERT_EQ(browser.entries.size(), 4u);
    EXPECT_TRUE(browser.entries[0].name == "tower" && browser.entries[0].is_folder);
    EXPECT_TRUE(browser.entries[1].name == "nave.proset" && !browser.entries[1].is_folder);
    EXPECT_EQ(browser.entries[2].name, "scan2.laz");
    browser.entries[0].chosen = browser.entries[3].chosen = true;
    EXPECT_EQ(chosenFiles(browser), std::vector<std::string>{folder.file("scan10.laz")});
}

TEST(FileBrowser, FoldersAreListedAndOtherPathsOpened) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder.file("tower"));
    fs::create_directories(folder.file("nave.proset"));
    EXPECT_TRUE(isToOpen(folder.write("scan.laz", "")));
    EXPECT_TRUE(isToOpen(folder.file("nave.proset")));
    EXPECT_FALSE(isToOpen(folder.file("tower")));
    EXPECT_FALSE(isToOpen(folder.file("missing.laz")));
}

TEST(FileBrowser, SaysWhyAFolderCannotBeRead) {
    const FileBrowser browser = browse("/no such folder");
    EXPECT_TRUE(browser.entries.empty());
    EXPECT_TRUE(browser.error.starts_with("/no such folder: ")) << browser.error;
}

} // namespace
} // namespace pointrt
