// SPDX-License-Identifier: Apache-2.0
// Advisory locks on open files and folders (flock).
#pragma once

#include <sys/file.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace pointrt::format {

enum class LockResult {
    kLocked,      ///< until the descriptor is closed or the process ends
    kTaken,       ///< another process has the lock
    kUnsupported, ///< no lock can be had here, as on some network file systems
};

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

/// The reason for an error line. @param error errno of tryLock, or of opening what was to be locked
inline std::string lockFailure(int error) {
    if (lockResultOf(error) == LockResult::kTaken) return "in use by another process";
    return "cannot be locked (" + std::generic_category().message(error) +
           "); use a file system that supports file locks";
}

} // namespace pointrt::format
