// SPDX-License-Identifier: Apache-2.0
// Locks distinguish a lock of another process from a file system without locks.
#include "format/base/file_lock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

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

TEST(FileLock, ReasonsDiffer) {
    EXPECT_SAYS(lockFailure(EWOULDBLOCK), "in use");
    EXPECT_SAYS(lockFailure(ENOLCK), "*(No locks available)");
}

TEST(FileLock, IsTakenUntilTheDescriptorIsClosed) {
    const test::TemporaryFolder folder;
    const auto openFolder = [&] { return open(folder.path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); };
    const int first = openFolder(), second = openFolder();
    EXPECT_EQ(tryLock(first), LockResult::kLocked);
    EXPECT_EQ(tryLock(second), LockResult::kTaken);
    EXPECT_EQ(errno, EWOULDBLOCK);
    close(first);
    EXPECT_EQ(tryLock(second), LockResult::kLocked);
    close(second);
    EXPECT_EQ(tryLock(second), LockResult::kUnsupported) << "closed";
}

} // namespace
} // namespace pointrt::format
