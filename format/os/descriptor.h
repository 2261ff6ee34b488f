// SPDX-License-Identifier: Apache-2.0
// Files read and written by descriptors. After a failure, errno has the reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace pointrt {

/// The numbers of the standard streams.
inline constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

enum class Opening {
    kRead,       ///< waits for the writer of a named pipe
    kReadNoWait, ///< does not wait for it
    kAppend      ///< created if it is missing
};

/// Returns the descriptor, which child processes do not inherit; negative if that fails.
int openFile(const std::string& path, Opening opening);

/// Opens a new file for reading and writing, only for this user, on the disk of `path`. The system deletes it when it
/// is closed. Negative if that fails.
int openUnnamedBeside(const std::string& path);

void closeFile(int descriptor);

/// Reads up to `bytes` bytes, perhaps fewer. Returns how many; 0 at the end, negative if it fails.
std::ptrdiff_t readSome(int descriptor, void* to, std::size_t bytes);
/// The same from an offset. Does not move the position at which later reads and writes continue.
std::ptrdiff_t readAt(int descriptor, void* to, std::size_t bytes, std::uint64_t offset);
/// Writes up to `bytes` bytes, perhaps fewer. Returns how many; negative if it fails.
std::ptrdiff_t writeSome(int descriptor, const void* from, std::size_t bytes);

/// Maps a regular file, read-only. Null if that fails.
const void* mapFile(int descriptor, std::size_t bytes);
void unmapFile(const void* start, std::size_t bytes);

enum class FileKind {
    kRegular,
    kFolder,
    kPipe,       ///< or a socket
    kCharacters, ///< a device such as a terminal
    kOther
};

struct FileStatus {
    FileKind kind = FileKind::kOther;
    std::uint64_t bytes = 0;              ///< of a regular file
    std::int64_t modified_ns = 0;         ///< of the last write, since 1970
    std::uint64_t device = 0, number = 0; ///< equal pairs mean the same file under another name
};

std::optional<FileStatus> statusOf(int descriptor);
/// The status of a file; for a symbolic link, that of its target.
std::optional<FileStatus> statusOf(const std::string& path);

/// Closes a descriptor.
class Descriptor {
public:
    explicit Descriptor(int number, bool owned = true) : number_(number), owned_(owned) {}
    ~Descriptor() {
        if (owned_ && number_ >= 0) closeFile(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return number_; }
    bool isOpen() const { return number_ >= 0; }

private:
    int number_;
    bool owned_; ///< not a standard stream
};

} // namespace pointrt
