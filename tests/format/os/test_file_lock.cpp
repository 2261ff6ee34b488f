// SPDX-License-Identifier: Apache-2.0
// Locks distinguish a lock of another process from a file system without locks.
#include "format/os/file_lock.h"

#include <filesystem>
#include <gtest/gtest.h>

#include "format/os/flock.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::format {
namespace {

TEST(FileLock, OnlyWouldBlockMeansTaken) {
    EXPECT_EQ(lockResultOf(0), LockResult::kLocked);
    EXPECT_EQ(lockResultOf(EWOULDBLOCK), LockResult::kTaken);
    for (const int error : {ENOLCK, EOPNOTSUPP, ENOSYS, EINVAL, EROFS, EACCES, EBADF})
        EXPECT_EQ(lockResultOf(error), LockResult::kUnsupported) << error;
}

TEST(FileLock, FoldersAreLockedUntilTheyAreReleased) {
    const test::TemporaryFolder folder;
    FileLock first, second;
    ASSERT_TRUE(first.openFolder(folder.path) && second.openFolder(folder.path));
    EXPECT_EQ(first.take(), LockResult::kLocked);
    EXPECT_EQ(second.take(), LockResult::kTaken);
    EXPECT_SAYS(second.failure(), "in use");
    first.release();
    EXPECT_EQ(second.take(), LockResult::kLocked);
    second.release();
    EXPECT_EQ(second.take(), LockResult::kUnsupported) << "closed";
    EXPECT_SAYS(second.failure(), "*(Bad file descriptor)");
}

TEST(FileLock, FilesAreCreatedForTheUserAlone) {
    namespace fs = std::filesystem;
    const test::TemporaryFolder folder;
    const std::string path = folder.file("x.lock");
    FileLock lock;
    ASSERT_TRUE(lock.openFile(path));
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(lock.take(), LockResult::kLocked);
    lock.removeFile();
    EXPECT_FALSE(fs::exists(path));
    EXPECT_FALSE(lock.isOpen());
}

TEST(FileLock, SaysWhatCannotBeOpened) {
    const test::TemporaryFolder folder;
    FileLock lock;
    EXPECT_FALSE(lock.openFile(folder.file("none/x.lock")));
    EXPECT_SAYS(lock.failure(), "*(No such file or directory)");
    EXPECT_FALSE(lock.openFolder(folder.file("none")));
}

} // namespace
} // namespace pointrt::format
