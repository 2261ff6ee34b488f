// SPDX-License-Identifier: Apache-2.0
// The lock is an exclusive right to delete the open file: unlike LockFileEx, this works on folders too.
#include "format/os/file_lock.h"

#include "format/os/wide_path_windows.h"

namespace pointrt::format {
namespace {

constexpr DWORD kShared = FILE_SHARE_READ | FILE_SHARE_WRITE;

} // namespace

bool FileLock::keep(std::intptr_t handle, const std::string& path) {
    path_ = path;
    handle_ = handle;
    if (!isOpen()) failure_ = "cannot be locked (" + windowsReason(GetLastError()) + ")";
    return isOpen();
}

bool FileLock::openFile(const std::string& path) {
    const HANDLE file = CreateFileW(widePath(path).c_str(), GENERIC_READ, kShared | FILE_SHARE_DELETE, nullptr,
                                    OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr);
    return keep(reinterpret_cast<std::intptr_t>(file), path);
}

bool FileLock::openFolder(const std::string& path) {
    const HANDLE folder = CreateFileW(widePath(path).c_str(), GENERIC_READ, kShared | FILE_SHARE_DELETE, nullptr,
                                      OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    return keep(reinterpret_cast<std::intptr_t>(folder), path);
}

LockResult FileLock::take() {
    const HANDLE locked = CreateFileW(widePath(path_).c_str(), DELETE, kShared, nullptr, OPEN_EXISTING,
                                      FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    const DWORD error = GetLastError();
    if (locked != INVALID_HANDLE_VALUE) {
        release();
        handle_ = reinterpret_cast<std::intptr_t>(locked);
        return LockResult::kLocked;
    }
    const bool is_taken = error == ERROR_SHARING_VIOLATION;
    failure_ = is_taken ? "in use by another process" : "cannot be locked (" + windowsReason(error) + ")";
    return is_taken ? LockResult::kTaken : LockResult::kUnsupported;
}

void FileLock::release() {
    if (isOpen()) CloseHandle(reinterpret_cast<HANDLE>(handle_));
    handle_ = kClosed;
}

void FileLock::removeFile() {
    release();
    DeleteFileW(widePath(path_).c_str()); // fails if another process has locked it in between
}

} // namespace pointrt::format
