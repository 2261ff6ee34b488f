// SPDX-License-Identifier: Apache-2.0
// The file is PATH.tmp-XXXXXXXX until commit. Windows does not delete open files, so one that can be deleted was left
// by a killed process.
#include <fcntl.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "format/os/atomic_file.h"
#include "format/os/temporary_name.h"
#include "format/os/wide_path_windows.h"

namespace pointrt::format {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kWriteAtOnce = std::size_t{1} << 30; // _write takes an unsigned int

void removeStale(const fs::path& path) {
    const std::string stem = temporaryStem(path.filename().string());
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path(), ignored))
        if (isTemporary(entry.path().filename().string(), stem)) fs::remove(entry.path(), ignored);
}

} // namespace

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) _close(descriptor_);
    if (named_) DeleteFileW(widePath(temporary_).c_str());
}

bool AtomicFile::fail(int error) {
    error_ = error == ENOENT   ? "the folder does not exist"
             : error == ENOSPC ? "the disk is full"
                               : std::generic_category().message(error);
    return false;
}

bool AtomicFile::open(const std::string& path, Existing existing) {
    existing_ = existing;
    path_ = path;
    if (widePath(path).empty()) return fail(ENOENT);
    std::error_code ignored;
    const fs::path target = fs::absolute(widePath(path), ignored);
    if (fs::is_directory(target, ignored)) {
        error_ = "it is a folder";
        return false;
    }
    if (existing == Existing::kKept && fs::exists(target, ignored)) return failExisting();
    removeStale(target);
    return openNamed();
}

bool AtomicFile::openNamed() {
    constexpr int kFlags = _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT;
    do {
        temporary_ = temporaryStem(path_) + randomLetters();
        descriptor_ = _wsopen(widePath(temporary_).c_str(), kFlags, _SH_DENYWR, _S_IREAD | _S_IWRITE);
    } while (descriptor_ < 0 && errno == EEXIST);
    named_ = descriptor_ >= 0;
    return named_ || fail(errno);
}

bool AtomicFile::write(const void* data, std::size_t bytes) {
    const char* next = static_cast<const char*>(data);
    while (bytes > 0) {
        const int written = _write(descriptor_, next, static_cast<unsigned>(std::min(bytes, kWriteAtOnce)));
        if (written < 0) return fail(errno);
        next += written;
        bytes -= static_cast<std::size_t>(written);
    }
    return true;
}

bool AtomicFile::overwrite(std::uint64_t offset, const void* data, std::size_t bytes) {
    const __int64 end = _lseeki64(descriptor_, 0, SEEK_CUR);
    if (end < 0 || _lseeki64(descriptor_, static_cast<__int64>(offset), SEEK_SET) < 0) return fail(errno);
    if (!write(data, bytes)) return false;
    return _lseeki64(descriptor_, end, SEEK_SET) >= 0 || fail(errno);
}

bool AtomicFile::commit() {
    if (_commit(descriptor_) != 0) return fail(errno);
    _close(std::exchange(descriptor_, -1)); // an open file cannot be renamed
    const DWORD flags = MOVEFILE_WRITE_THROUGH | (existing_ == Existing::kReplaced ? MOVEFILE_REPLACE_EXISTING : 0);
    if (MoveFileExW(widePath(temporary_).c_str(), widePath(path_).c_str(), flags) == 0) {
        const DWORD error = GetLastError();
        if (error == ERROR_ALREADY_EXISTS || error == ERROR_FILE_EXISTS) return failExisting();
        error_ = windowsReason(error);
        return false;
    }
    named_ = false;
    return true;
}

} // namespace pointrt::format
