// SPDX-License-Identifier: Apache-2.0
// Files by their descriptors: their type, what is read, and what remains on the disk.
#include "format/os/descriptor.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <string_view>

#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

FileKind kindOf(const std::string& path) { return statusOf(path).value().kind; }

TEST(FileStatus, TellsKindsApart) {
    const test::TemporaryFolder folder;
    const std::string file = folder.write("file", "four"), pipe = folder.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(kindOf(file), FileKind::kRegular);
    EXPECT_EQ(statusOf(file)->bytes, 4u);
    EXPECT_EQ(kindOf(folder.path), FileKind::kFolder);
    EXPECT_EQ(kindOf(pipe), FileKind::kPipe);
    EXPECT_EQ(kindOf("/dev/null"), FileKind::kCharacters);
    EXPECT_FALSE(statusOf(folder.file("none")));
    EXPECT_EQ(errno, ENOENT);
}

TEST(FileStatus, KnowsAFileUnderAnotherName) {
    const test::TemporaryFolder folder;
    const std::string one = folder.write("one", "x"), two = folder.write("two", "x");
    fs::create_symlink(one, folder.path / "link");
    const auto number = [](const std::string& path) { return statusOf(path).value().number; };
    EXPECT_EQ(number(one), number(folder.file("link")));
    EXPECT_NE(number(one), number(two));
}

TEST(Descriptor, DoesNotWaitForTheWriterOfAPipe) {
    const test::TemporaryFolder folder;
    const std::string pipe = folder.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const Descriptor opened(openFile(pipe, Opening::kReadNoWait));
    ASSERT_TRUE(opened.isOpen());
    EXPECT_EQ(statusOf(opened.number())->kind, FileKind::kPipe);
}

TEST(Descriptor, UnnamedFilesLeaveNothingAndAppendBehindReads) {
    const test::TemporaryFolder folder;
    const Descriptor unnamed(openUnnamedBeside(folder.file("output")));
    ASSERT_TRUE(unnamed.isOpen());
    EXPECT_EQ(folder.entries(), 0u);
    std::array<char, 8> text{};
    EXPECT_EQ(writeSome(unnamed.number(), "abc", 3), 3);
    EXPECT_EQ(readAt(unnamed.number(), text.data(), 2, 1), 2);
    EXPECT_EQ(writeSome(unnamed.number(), "def", 3), 3);
    EXPECT_EQ(readAt(unnamed.number(), text.data(), text.size(), 0), 6) << "a read past the end is short";
    EXPECT_EQ(std::string_view(text.data(), 6), "abcdef");
}

} // namespace
} // namespace pointrt
