// SPDX-License-Identifier: Apache-2.0
// A file that appears complete under its name, or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pointrt::format {

/// What becomes of a file that has the name already when the new one is complete.
enum class Existing {
    kReplaced, ///< its permissions, and where that is allowed its owner, are the new one's
    kKept      ///< the new one fails, whoever made the other one and whenever
};

/// Where the file system allows it, the file has no name until commit, so that not even SIGKILL leaves anything behind.
/// Elsewhere, and for the moment in which it replaces another one, it is PATH.tmp-XXXXXXXX, locked, and the next one of
/// PATH that takes such a name removes what a killed process has left of those. Without commit the destructor removes
/// it. Where path is a symbolic link, the file is the one it leads to, and the link stays.
class AtomicFile {
public:
    AtomicFile() = default;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Each returns false on failure, and error() then says why in a few words. After a failure only the
    /// destructor may follow.
    bool open(const std::string& path, Existing existing = Existing::kReplaced);
    bool write(const void* data, std::size_t bytes);
    /// In place of bytes that were written before.
    bool overwrite(std::uint64_t offset, const void* data, std::size_t bytes);
    bool commit(); ///< syncs, gives the file its name, syncs the folder

    const std::string& error() const { return error_; }
    /// Whether it failed because a file has the name already: Existing::kKept.
    bool nameIsTaken() const { return name_is_taken_; }

private:
    bool fail(int error);
    bool failExisting() {
        error_ = "exists already";
        name_is_taken_ = true;
        return false;
    }
    bool openNamed();
    bool link(const std::string& name) const;
    bool nameUnnamed();
    bool replace();
    bool appear();
    void takeOver();

    std::string path_, folder_, temporary_, error_;
    Existing existing_ = Existing::kReplaced;
    int descriptor_ = -1;
    bool named_ = false; // temporary_ exists
    bool name_is_taken_ = false;
};

} // namespace pointrt::format
