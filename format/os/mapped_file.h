// SPDX-License-Identifier: Apache-2.0
// Read-only memory-mapped files.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace pointrt::format {

/// Unmaps when destroyed. The bytes change if another process writes to the file, and reading past the end of a file
/// truncated later raises SIGBUS (see prepareProcess). .pro files are replaced by renaming, never written in place.
class MappedFile {
public:
    MappedFile() = default;
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    ~MappedFile();

    /// Maps path; call it once. Returns false if path is empty or not a regular file; error() then has the reason.
    bool map(const char* path);

    const std::string& error() const { return error_; }
    /// Whether map failed for lack of memory.
    bool outOfMemory() const { return out_of_memory_; }

    /// Drops the pages from the memory of this process, not from the file cache; reading them maps them again.
    void dropPages() const;

    std::span<const std::byte> bytes() const { return {data_, size_}; }

private:
    bool fail(const std::string& reason);
    bool fail(int error);

    const std::byte* data_ = nullptr;
    std::size_t size_ = 0;
    std::string error_;
    bool out_of_memory_ = false;
};

} // namespace pointrt::format
