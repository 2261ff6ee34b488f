// SPDX-License-Identifier: Apache-2.0
// A file that appears complete under its name, or not at all.
#pragma once

#include <cstddef>
#include <string>

namespace pointrt::format {

/// Where the file system allows it, the file has no name until commit, so that not even SIGKILL leaves anything
/// behind; elsewhere it is PATH.tmp-PID until then. Without commit the destructor removes it.
class AtomicFile {
public:
    AtomicFile() = default;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Each returns false on failure, and error() then says why in a few words. After a failure only the
    /// destructor may follow.
    bool open(const std::string& path);
    bool write(const void* data, std::size_t bytes);
    bool commit(); ///< syncs, renames over path, syncs the folder

    const std::string& error() const { return error_; }

private:
    bool fail(int error);
    bool nameUnnamed();

    std::string path_, folder_, temporary_, error_;
    int descriptor_ = -1;
    bool named_ = false; // temporary_ exists
};

} // namespace pointrt::format
