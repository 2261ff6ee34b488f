// SPDX-License-Identifier: Apache-2.0
// A whole file in memory, read-only.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace pointrt::format {

/// Unmaps when destroyed. The bytes change if another process writes into the file, and reading past a file that
/// was cut short raises SIGBUS (see prepareProcess): .pro files are replaced by renaming, never written in place.
class MappedFile {
public:
    MappedFile() = default;
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    ~MappedFile();

    /// Maps path once. Returns false for what is no regular file or is empty, and error() then says why in a few words.
    bool map(const char* path);

    const std::string& error() const { return error_; }
    /// Whether it was memory that map lacked: then the file is not to blame.
    bool outOfMemory() const { return out_of_memory_; }

    /// Takes the pages out of this process's memory, though not out of the file cache; they come back when touched.
    void letGo() const;

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
