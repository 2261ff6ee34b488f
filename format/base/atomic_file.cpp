// SPDX-License-Identifier: Apache-2.0
#include "format/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace pointrt::format {

namespace {

constexpr mode_t kMode = 0666;                             // less the umask
constexpr std::size_t kWriteAtOnce = std::size_t{1} << 30; // write(2) stops short of 2 GiB on Linux

std::string folderOf(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

std::string describe(int error) {
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return "the folder does not exist";
    case ENOSPC:
        return "the disk is full";
    case EDQUOT:
        return "the disk quota is used up";
    case EFBIG:
        return "the file is too large for its file system or the user's limit";
    default:
        return std::generic_category().message(error);
    }
}

std::string descriptorPath(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// -1 where the file system has no nameless files, or /proc is missing, through which one gets its name.
int openUnnamed(const std::string& folder) {
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) == 0) return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kMode);
#endif
    (void)folder;
    return -1;
}

} // namespace

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (named_) unlink(temporary_.c_str());
}

bool AtomicFile::fail(int error) {
    error_ = describe(error);
    return false;
}

bool AtomicFile::open(const std::string& path) {
    path_ = path;
    folder_ = folderOf(path);
    temporary_ = path + ".tmp-" + std::to_string(getpid());
    struct stat status;
    if (path.empty()) return fail(EINVAL);
    if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
        error_ = S_ISDIR(status.st_mode) ? "it is a folder" : "not a regular file"; // never rename over a device
        return false;
    }
    descriptor_ = openUnnamed(folder_);
    if (descriptor_ >= 0) return true;
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
    if (descriptor_ < 0) return fail(errno);
    named_ = true;
    return true;
}

bool AtomicFile::write(const void* data, std::size_t bytes) {
    const char* next = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t written = ::write(descriptor_, next, std::min(bytes, kWriteAtOnce));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail(errno);
        next += written;
        bytes -= static_cast<std::size_t>(written);
    }
    return true;
}

bool AtomicFile::nameUnnamed() {
    const std::string unnamed = descriptorPath(descriptor_);
    if (linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, temporary_.c_str(), AT_SYMLINK_FOLLOW) != 0) return fail(errno);
    named_ = true;
    return true;
}

bool AtomicFile::commit() {
    if (fsync(descriptor_) != 0) return fail(errno);
    if (!named_ && !nameUnnamed()) return false;
    if (rename(temporary_.c_str(), path_.c_str()) != 0) return fail(errno);
    named_ = false;
    // the file is in place: what fails from here on could not be undone and only weakens safety against power loss
    const int folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        fsync(folder);
        close(folder);
    }
    return true;
}

} // namespace pointrt::format
