// SPDX-License-Identifier: Apache-2.0
#include "format/os/descriptor.h"

#include <fcntl.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>

#include "format/os/temporary_name.h"
#include "format/os/wide_path_windows.h"

namespace pointrt {

using format::widePath;

namespace {

constexpr std::size_t kAtOnce = std::size_t{1} << 30; // _read and _write take an unsigned int and return an int
constexpr int kCommonFlags = _O_BINARY | _O_NOINHERIT;

unsigned atOnce(std::size_t bytes) { return static_cast<unsigned>(std::min(bytes, kAtOnce)); }

HANDLE handleOf(int descriptor) { return reinterpret_cast<HANDLE>(_get_osfhandle(descriptor)); }

std::uint64_t joined(DWORD high, DWORD low) { return std::uint64_t{high} << 32 | low; }

/// Windows counts in 100 ns since 1601.
std::int64_t nanoseconds(FILETIME time) {
    constexpr std::int64_t kFrom1601To1970 = 11'644'473'600; // in seconds
    const auto ticks = static_cast<std::int64_t>(joined(time.dwHighDateTime, time.dwLowDateTime));
    return (ticks - kFrom1601To1970 * 10'000'000) * 100;
}

std::optional<FileStatus> statusOf(HANDLE handle) {
    FileStatus status;
    const DWORD type = GetFileType(handle);
    if (type == FILE_TYPE_PIPE) status.kind = FileKind::kPipe;
    if (type == FILE_TYPE_CHAR) status.kind = FileKind::kCharacters;
    if (type != FILE_TYPE_DISK) return status;
    BY_HANDLE_FILE_INFORMATION information{};
    if (GetFileInformationByHandle(handle, &information) == 0) return {};
    const bool is_folder = (information.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    status.kind = is_folder ? FileKind::kFolder : FileKind::kRegular;
    status.bytes = joined(information.nFileSizeHigh, information.nFileSizeLow);
    status.modified_ns = nanoseconds(information.ftLastWriteTime);
    status.device = information.dwVolumeSerialNumber;
    status.number = joined(information.nFileIndexHigh, information.nFileIndexLow);
    return status;
}

} // namespace

int openFile(const std::string& path, Opening opening) {
    if (opening == Opening::kAppend)
        return _wsopen(widePath(path).c_str(), _O_WRONLY | _O_CREAT | _O_APPEND | kCommonFlags, _SH_DENYNO,
                       _S_IREAD | _S_IWRITE);
    return _wsopen(widePath(path).c_str(), _O_RDONLY | kCommonFlags, _SH_DENYNO, 0);
}

int openUnnamedBeside(const std::string& path) {
    const std::string name = format::temporaryStem(path) + format::randomLetters();
    return _wsopen(widePath(name).c_str(), _O_RDWR | _O_CREAT | _O_EXCL | _O_TEMPORARY | kCommonFlags, _SH_DENYNO,
                   _S_IREAD | _S_IWRITE);
}

void closeFile(int descriptor) { _close(descriptor); }

std::ptrdiff_t readSome(int descriptor, void* to, std::size_t bytes) { return _read(descriptor, to, atOnce(bytes)); }

std::ptrdiff_t readAt(int descriptor, void* to, std::size_t bytes, std::uint64_t offset) {
    const __int64 before = _telli64(descriptor);
    if (before < 0 || _lseeki64(descriptor, static_cast<__int64>(offset), SEEK_SET) < 0) return -1;
    const int got = _read(descriptor, to, atOnce(bytes));
    return _lseeki64(descriptor, before, SEEK_SET) < 0 ? -1 : got;
}

std::ptrdiff_t writeSome(int descriptor, const void* from, std::size_t bytes) {
    return _write(descriptor, from, atOnce(bytes));
}

const void* mapFile(int descriptor, std::size_t bytes) {
    const HANDLE mapping = CreateFileMappingW(handleOf(descriptor), nullptr, PAGE_READONLY, 0, 0, nullptr);
    if (!mapping) return nullptr;
    const void* const start = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, bytes);
    CloseHandle(mapping); // the view keeps it
    return start;
}

void unmapFile(const void* start, std::size_t) { UnmapViewOfFile(start); }

/// A file whose status Windows does not know can be read as a pipe: it was opened by a Linux shell for Wine.
std::optional<FileStatus> statusOf(int descriptor) {
    const HANDLE handle = handleOf(descriptor);
    const std::optional<FileStatus> status = statusOf(handle);
    if (status || GetFileType(handle) != FILE_TYPE_DISK) return status;
    return FileStatus{.kind = FileKind::kPipe};
}

std::optional<FileStatus> statusOf(const std::string& path) {
    const HANDLE handle = CreateFileW(widePath(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                      nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = GetLastError() == ERROR_ACCESS_DENIED ? EACCES : ENOENT;
        return {};
    }
    const std::optional<FileStatus> status = statusOf(handle);
    CloseHandle(handle);
    return status;
}

} // namespace pointrt
