// SPDX-License-Identifier: Apache-2.0
#include "format/os/atomic_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "format/os/flock.h"
#include "format/os/temporary_name.h"

namespace pointrt::format {

namespace {

constexpr mode_t kMode = 0666;                             // reduced by the umask
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

/// Opens an unnamed file. Returns -1 if the file system does not support that, or if /proc, through which linkat later
/// names the file, is missing.
int openUnnamed(const std::string& folder) {
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) == 0) return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kMode);
#endif
    (void)folder;
    return -1;
}

/// The target of path after following symbolic links; it need not exist. Empty, with errno, if the links form a loop or
/// cannot be read.
std::string followLinks(std::string path) {
    constexpr int kMostLinks = 40; // the limit of Linux
    for (int i = 0; i < kMostLinks; ++i) {
        struct stat status;
        if (lstat(path.c_str(), &status) != 0 || !S_ISLNK(status.st_mode)) return path;
        std::string target(4096, 0); // PATH_MAX
        const ssize_t bytes = readlink(path.c_str(), target.data(), target.size());
        if (bytes < 0) return {};
        target.resize(static_cast<std::size_t>(bytes));
        path = target.starts_with('/') ? target : folderOf(path) + "/" + target;
    }
    errno = ELOOP;
    return {};
}

/// Deletes temporary files that killed processes left for path: those that no process has locked.
void removeStale(const std::string& path, const std::string& folder) {
    const std::string stem = temporaryStem(path.substr(path.rfind('/') + 1));
    DIR* const entries = opendir(folder.c_str());
    if (!entries) return;
    while (const dirent* entry = readdir(entries)) {
        if (!isTemporary(entry->d_name, stem)) continue;
        const int stale = openat(dirfd(entries), entry->d_name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
        if (stale < 0) continue;
        if (tryLock(stale) == LockResult::kLocked) unlinkat(dirfd(entries), entry->d_name, 0);
        close(stale);
    }
    closedir(entries);
}

/// Renames a file unless the new name exists. False, with errno, on failure.
bool renameWithoutReplacing(const std::string& from, const std::string& to) {
#ifdef RENAME_NOREPLACE
    if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS) return false; // not supported by the file system
#endif
    if (link(from.c_str(), to.c_str()) == 0) return unlink(from.c_str()) == 0;
    if (errno == EEXIST) return false;
    // For file systems without hard links, such as FAT. It has a race: a file that another process creates between
    // access and rename is replaced.
    if (access(to.c_str(), F_OK) == 0) {
        errno = EEXIST;
        return false;
    }
    return rename(from.c_str(), to.c_str()) == 0;
}

} // namespace

AtomicFile::~AtomicFile() {
    if (named_) unlink(temporary_.c_str());
    if (descriptor_ >= 0) close(descriptor_);
}

bool AtomicFile::fail(int error) {
    error_ = describe(error);
    return false;
}

bool AtomicFile::open(const std::string& path, Existing existing) {
    existing_ = existing;
    if (path.empty()) return fail(ENOENT);
    path_ = followLinks(path);
    if (path_.empty()) return fail(errno);
    folder_ = folderOf(path_);
    struct stat status;
    const bool is_there = stat(path_.c_str(), &status) == 0;
    if (is_there && !S_ISREG(status.st_mode)) {
        error_ = S_ISDIR(status.st_mode) ? "it is a folder" : "not a regular file"; // never replace a device
        return false;
    }
    if (is_there && existing == Existing::kKept) return failExisting();
    descriptor_ = openUnnamed(folder_);
    return descriptor_ >= 0 || openNamed();
}

bool AtomicFile::openNamed() {
    constexpr int kTries = 100; // another process may delete the file as stale before it is locked
    removeStale(path_, folder_);
    for (int i = 0; i < kTries; ++i) {
        temporary_ = temporaryStem(path_) + randomLetters();
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
        if (descriptor_ < 0 && errno == EEXIST) continue;
        // a folder such as /proc/self/fd, which exists but cannot hold files, gives this error
        if (descriptor_ < 0 && errno == ENOENT && access(folder_.c_str(), F_OK) == 0) {
            error_ = "cannot create files in " + folder_;
            return false;
        }
        if (descriptor_ < 0) return fail(errno);
        tryLock(descriptor_); // without file locks no process deletes stale files
        struct stat status;
        named_ = fstat(descriptor_, &status) == 0 && status.st_nlink > 0;
        if (named_) return true;
        close(std::exchange(descriptor_, -1));
    }
    return fail(EEXIST);
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

/// Copies the permissions, and if allowed the owner, of the file that is replaced.
void AtomicFile::copyOwnership() {
    constexpr mode_t kPermissions = 0777; // without set-user-ID and set-group-ID
    struct stat before;
    if (stat(path_.c_str(), &before) != 0) return;
    // not allowed to change the owner: keep ours
    if (fchown(descriptor_, before.st_uid, before.st_gid) != 0) errno = 0;
    fchmod(descriptor_, before.st_mode & kPermissions);
}

bool AtomicFile::overwrite(std::uint64_t offset, const void* data, std::size_t bytes) {
    const char* next = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t written = ::pwrite(descriptor_, next, std::min(bytes, kWriteAtOnce), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail(errno);
        next += written;
        offset += static_cast<std::uint64_t>(written);
        bytes -= static_cast<std::size_t>(written);
    }
    return true;
}

/// Links an unnamed file to a name unless the name exists. False, with errno, on failure.
bool AtomicFile::link(const std::string& name) const {
    return linkat(AT_FDCWD, descriptorPath(descriptor_).c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

/// Links an unnamed file to a temporary name, since linkat cannot replace a file.
bool AtomicFile::nameUnnamed() {
    removeStale(path_, folder_);
    temporary_ = temporaryStem(path_) + randomLetters();
    tryLock(descriptor_);
    named_ = link(temporary_);
    return named_ || fail(errno);
}

bool AtomicFile::replace() {
    copyOwnership();
    if (!named_ && link(path_)) return true;
    if (!named_ && errno != EEXIST) return fail(errno);
    if (!named_ && !nameUnnamed()) return false;
    if (rename(temporary_.c_str(), path_.c_str()) != 0) return fail(errno);
    named_ = false;
    return true;
}

bool AtomicFile::appear() {
    const bool appeared = named_ ? renameWithoutReplacing(temporary_, path_) : link(path_);
    if (!appeared) return errno == EEXIST ? failExisting() : fail(errno);
    named_ = false;
    return true;
}

bool AtomicFile::commit() {
    if (fsync(descriptor_) != 0) return fail(errno);
    if (!(existing_ == Existing::kKept ? appear() : replace())) return false;
    // the file is in place; a failure from here on only weakens safety against power loss
    const int folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        fsync(folder);
        close(folder);
    }
    return true;
}

} // namespace pointrt::format
