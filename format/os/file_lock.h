// SPDX-License-Identifier: Apache-2.0
// Advisory locks on files and folders.
#pragma once

#include <cstdint>
#include <string>

#include "format/os/lock_result.h"

namespace pointrt::format {

/// An exclusive lock, held until it is destroyed or the process ends.
class FileLock {
public:
    FileLock() = default;
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    ~FileLock() { release(); }

    /// Opens the file at path; creates it, accessible only to the user, if it is missing. False if that fails:
    /// failure() then has the reason.
    bool openFile(const std::string& path);
    /// The same for a folder, which must exist.
    bool openFolder(const std::string& path);
    bool isOpen() const { return handle_ != kClosed; }

    /// Locks the open file or folder, without waiting. failure() has the reason if it fails.
    LockResult take();

    /// Why the last call failed, for an error line.
    const std::string& failure() const { return failure_; }

    /// Closes the file or folder, which releases its lock.
    void release();
    /// Deletes the locked file and releases its lock.
    void removeFile();

private:
    bool keep(std::intptr_t handle, const std::string& path);

    static constexpr std::intptr_t kClosed = -1;
    std::intptr_t handle_ = kClosed; ///< a descriptor, or a HANDLE of Windows
    std::string path_, failure_;
};

} // namespace pointrt::format
