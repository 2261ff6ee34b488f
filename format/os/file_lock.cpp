// SPDX-License-Identifier: Apache-2.0
#include "format/os/file_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <system_error>

#include "format/os/flock.h"

namespace pointrt::format {
namespace {

constexpr mode_t kOwnerOnly = 0600;

std::string describe(int error) {
    if (lockResultOf(error) == LockResult::kTaken) return "in use by another process";
    return "cannot be locked (" + std::generic_category().message(error) +
           "); use a file system that supports file locks";
}

} // namespace

bool FileLock::keep(std::intptr_t handle, const std::string& path) {
    path_ = path;
    handle_ = handle;
    if (!isOpen()) failure_ = describe(errno);
    return isOpen();
}

bool FileLock::openFile(const std::string& path) {
    return keep(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kOwnerOnly), path);
}

bool FileLock::openFolder(const std::string& path) {
    return keep(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC), path);
}

LockResult FileLock::take() {
    const LockResult result = tryLock(static_cast<int>(handle_));
    if (result != LockResult::kLocked) failure_ = describe(errno);
    return result;
}

void FileLock::release() {
    if (isOpen()) ::close(static_cast<int>(handle_));
    handle_ = kClosed;
}

void FileLock::removeFile() {
    ::unlink(path_.c_str());
    release();
}

} // namespace pointrt::format
