// SPDX-License-Identifier: Apache-2.0
// flock(2) on descriptors, without waiting, for the non-Windows sources of format/os.
#pragma once

#include <sys/file.h>

#include <cerrno>

#include "format/os/lock_result.h"

namespace pointrt::format {

/// What an errno of a non-blocking flock means; 0 is success.
inline LockResult lockResultOf(int error) {
    if (error == 0) return LockResult::kLocked;
    return error == EWOULDBLOCK ? LockResult::kTaken : LockResult::kUnsupported;
}

/// Takes an exclusive lock without waiting for it. errno has the reason if it fails.
inline LockResult tryLock(int descriptor) {
    int error = 0;
    do error = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    while (error == EINTR);
    errno = error;
    return lockResultOf(error);
}

} // namespace pointrt::format
