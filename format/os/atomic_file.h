// SPDX-License-Identifier: Apache-2.0
// Atomically written files: they appear complete under their name, or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pointrt::format {

/// What happens to an existing file of the same name.
enum class Existing {
    kReplaced, ///< the new file gets its permissions and, if allowed, its owner
    kKept      ///< the new file fails, even if the existing one appears just before commit
};

/// The file has no name until commit, so even SIGKILL leaves nothing behind. On file systems without unnamed files, and
/// for the moment of replacing another file, it is named PATH.tmp-XXXXXXXX and locked; the next AtomicFile that needs
/// such a name for PATH deletes unlocked ones, which are left over from killed processes. The destructor deletes a file
/// that was not committed. If path is a symbolic link, the file is its target, and the link stays.
class AtomicFile {
public:
    AtomicFile() = default;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// All return false on failure; error() then has the reason. After a failure only the destructor may follow.
    bool open(const std::string& path, Existing existing = Existing::kReplaced);
    bool write(const void* data, std::size_t bytes);
    /// Replaces bytes written before.
    bool overwrite(std::uint64_t offset, const void* data, std::size_t bytes);
    bool commit(); ///< syncs, gives the file its name, syncs the folder

    const std::string& error() const { return error_; }
    /// Whether the failure was that the file exists (Existing::kKept).
    bool nameIsTaken() const { return name_is_taken_; }

private:
    bool fail(int error);
    bool failExisting() {
        error_ = "already exists";
        name_is_taken_ = true;
        return false;
    }
    bool openNamed();
    bool link(const std::string& name) const;
    bool nameUnnamed();
    bool replace();
    bool appear();
    void copyOwnership();

    std::string path_, folder_, temporary_, error_;
    Existing existing_ = Existing::kReplaced;
    int descriptor_ = -1;
    bool named_ = false; // temporary_ exists
    bool name_is_taken_ = false;
};

} // namespace pointrt::format
