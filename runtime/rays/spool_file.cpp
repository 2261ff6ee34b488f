// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/spool_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "format/base/error.h"
#include "format/base/temporary_name.h"

namespace pointrt {
namespace {

constexpr std::size_t kAtOnce = std::size_t{1} << 20; // makes calls negligible; zlib takes 32 bits at most

[[noreturn]] void failWriting(const std::string& output) {
    throw Error(ExitCode::kCannotWrite, output + ": " + std::strerror(errno));
}

/// On file systems without O_TMPFILE the file briefly has a name; if the process is killed in between, the next
/// AtomicFile of this output deletes it.
int openUnnamed(const std::string& output) {
    constexpr mode_t kOwnerOnly = 0600;
    const std::filesystem::path folder = std::filesystem::path(output).parent_path();
    const int unnamed = ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kOwnerOnly);
    if (unnamed >= 0) return unnamed;
    const std::string name = format::temporaryStem(output) + format::randomLetters();
    const int named = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kOwnerOnly);
    if (named >= 0) ::unlink(name.c_str());
    return named;
}

} // namespace

SpoolFile::SpoolFile(std::string output) : output_(std::move(output)), descriptor_(openUnnamed(output_)) {
    if (descriptor_ < 0) failWriting(output_);
}

SpoolFile::~SpoolFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void SpoolFile::append(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const std::size_t part = std::min(bytes.size(), kAtOnce);
        const ssize_t done = ::write(descriptor_, bytes.data(), part);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) failWriting(output_);
        const auto written = static_cast<std::size_t>(done);
        checksum_ = static_cast<std::uint32_t>(
            crc32(checksum_, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(written)));
        size_ += written;
        bytes = bytes.subspan(written);
    }
}

void SpoolFile::copyTo(OutputFile& file) const {
    std::vector<std::uint8_t> room(kAtOnce);
    for (std::uint64_t at = 0; at < size_;) {
        const ssize_t got = ::pread(descriptor_, room.data(), room.size(), static_cast<off_t>(at));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) failWriting(output_);
        file.append({room.data(), static_cast<std::size_t>(got)});
        at += static_cast<std::uint64_t>(got);
    }
}

} // namespace pointrt
