// SPDX-License-Identifier: Apache-2.0
#include "format/os/descriptor.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "format/os/temporary_name.h"

namespace pointrt {
namespace {

constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // read(2) and write(2) stop short of 2 GiB on Linux
constexpr mode_t kReadByAll = 0666, kOwnerOnly = 0600; // reduced by the umask

/// Repeats a call that a signal interrupted.
template <typename Call>
std::ptrdiff_t uninterrupted(const Call& call) {
    ssize_t done = 0;
    do done = call();
    while (done < 0 && errno == EINTR);
    return done;
}

FileKind kindOf(mode_t mode) {
    if (S_ISREG(mode)) return FileKind::kRegular;
    if (S_ISDIR(mode)) return FileKind::kFolder;
    if (S_ISFIFO(mode) || S_ISSOCK(mode)) return FileKind::kPipe;
    return S_ISCHR(mode) ? FileKind::kCharacters : FileKind::kOther;
}

FileStatus fileStatus(const struct stat& status) {
    return {kindOf(status.st_mode), static_cast<std::uint64_t>(status.st_size),
            std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec, status.st_dev, status.st_ino};
}

} // namespace

int openFile(const std::string& path, Opening opening) {
    switch (opening) {
    case Opening::kRead:
        return ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    case Opening::kReadNoWait:
        return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    case Opening::kAppend:
        break;
    }
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kReadByAll);
}

/// On file systems without O_TMPFILE the file briefly has a name; if the process is killed in between, the next
/// AtomicFile of this path deletes it.
int openUnnamedBeside(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, std::max<std::size_t>(slash, 1));
    const int unnamed = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kOwnerOnly);
    if (unnamed >= 0) return unnamed;
    const std::string name = format::temporaryStem(path) + format::randomLetters();
    const int named = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kOwnerOnly);
    if (named >= 0) ::unlink(name.c_str());
    return named;
}

void closeFile(int descriptor) { ::close(descriptor); }

std::ptrdiff_t readSome(int descriptor, void* to, std::size_t bytes) {
    return uninterrupted([&] { return ::read(descriptor, to, std::min(bytes, kAtOnce)); });
}

std::ptrdiff_t readAt(int descriptor, void* to, std::size_t bytes, std::uint64_t offset) {
    return uninterrupted([&] { return ::pread(descriptor, to, std::min(bytes, kAtOnce), static_cast<off_t>(offset)); });
}

std::ptrdiff_t writeSome(int descriptor, const void* from, std::size_t bytes) {
    return uninterrupted([&] { return ::write(descriptor, from, std::min(bytes, kAtOnce)); });
}

const void* mapFile(int descriptor, std::size_t bytes) {
    void* const start = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, descriptor, 0);
    return start == MAP_FAILED ? nullptr : start;
}

void unmapFile(const void* start, std::size_t bytes) { ::munmap(const_cast<void*>(start), bytes); }

std::optional<FileStatus> statusOf(int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return {};
    return fileStatus(status);
}

std::optional<FileStatus> statusOf(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return {};
    return fileStatus(status);
}

} // namespace pointrt
