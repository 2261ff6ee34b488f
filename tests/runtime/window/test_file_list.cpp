// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/file_list.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/window/edit/free_name.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

using FileNames = std::vector<std::string>;

TEST(FileList, SortsNumbersByValue) {
    const FileNames sorted{"",
                           "10",
                           "a",
                           "a01",
                           "a1",
                           "a2b1",
                           "a2b10",
                           "a10",
                           "b007",
                           "b7",
                           "b07x",
                           "b8",
                           "img2",
                           "img10",
                           "img10a",
                           "scan.pro",
                           "z99999999999999999999",
                           "z100000000000000000000"};
    FileNames shuffled = sorted;
    std::reverse(shuffled.begin(), shuffled.end());
    std::sort(shuffled.begin(), shuffled.end(), naturallyLess);
    EXPECT_EQ(shuffled, sorted);
}

TEST(FileList, NaturalOrderIsStrict) {
    const FileNames names{"", "0", "00", "1", "01", "1a", "01a", "a", "a0", "a00b", "\xff", "10", "9"};
    for (const std::string& a : names)
        for (const std::string& b : names) {
            EXPECT_EQ(naturallyLess(a, b) + naturallyLess(b, a), a != b) << a << " " << b;
            for (const std::string& c : names)
                if (naturallyLess(a, b) && naturallyLess(b, c)) {
                    EXPECT_TRUE(naturallyLess(a, c)) << a << " " << b << " " << c;
                }
        }
}

TEST(FileList, ListsScenesOfAFolder) {
    const test::TemporaryFolder folder;
    for (const char* name : {"img10.pro", "img2.pro", "img2.toml", "scan.ply", ".hidden.pro", "noext"})
        folder.write(name, "");
    std::filesystem::create_directory(folder.path / "folder.pro");
    EXPECT_EQ(sceneFiles(folder.path.string()),
              (FileNames{folder.file("img2.pro"), folder.file("img2.toml"), folder.file("img10.pro")}));
    EXPECT_EQ(sceneFiles(folder.file("none")), FileNames{});
    EXPECT_EQ(sceneFiles(folder.file("img2.pro")), FileNames{});
}

TEST(FileList, WrapsAround) {
    const test::TemporaryFolder folder;
    for (const char* name : {"img1.pro", "img2.pro", "img10.toml"}) folder.write(name, "");
    const auto step = [&](const char* name, int by) {
        return std::filesystem::path(neighbourFile(folder.file(name), by)).filename().string();
    };
    EXPECT_EQ(step("img1.pro", 1), "img2.pro");
    EXPECT_EQ(step("img2.pro", 1), "img10.toml");
    EXPECT_EQ(step("img10.toml", 1), "img1.pro");
    EXPECT_EQ(step("img1.pro", -1), "img10.toml");
    EXPECT_EQ(step("img1.pro", -5), "img2.pro");
    EXPECT_EQ(step("img1.pro", 3), "");
    EXPECT_EQ(step("img5.pro", 1), "img10.toml") << "where it was";
    EXPECT_EQ(step("img5.pro", -1), "img2.pro");
    EXPECT_EQ(step("img0.pro", -1), "img10.toml");
    EXPECT_EQ(step("zebra.pro", 1), "img1.pro");
    EXPECT_EQ(neighbourFile(folder.path.string() + "//img1.pro", 1), folder.file("img2.pro"));
    EXPECT_EQ(neighbourFile(folder.file("none/img1.pro"), 1), "");
}

TEST(FileList, SingleSceneHasNoNeighbour) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(neighbourFile(folder.write("only.pro", ""), 1), "");
    EXPECT_EQ(neighbourFile(folder.file("gone.pro"), 1), folder.file("only.pro"));
}

TEST(FreeName, IsTheFirstUnusedNumber) {
    const test::TemporaryFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path);
    EXPECT_EQ(freeName("scans/statue.pro", {".png", ".exr"}), "statue-1");
    folder.write("statue-1.exr", "");
    folder.write("statue-2.png", "");
    folder.write("statue-3.toml", "");
    EXPECT_EQ(freeName("scans/statue.pro", {".png", ".exr"}), "statue-3");
    EXPECT_EQ(freeName("", {".png"}), "picture-1");
    std::filesystem::current_path(before);
}

} // namespace
} // namespace pointrt
