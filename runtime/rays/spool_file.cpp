// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/spool_file.h"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "format/base/error.h"
#include "format/os/descriptor.h"

namespace pointrt {
namespace {

constexpr std::size_t kAtOnce = std::size_t{1} << 20; // makes calls negligible; zlib takes 32 bits at most

[[noreturn]] void failWriting(const std::string& output) {
    throw Error(ExitCode::kCannotWrite, output + ": " + std::strerror(errno));
}

} // namespace

SpoolFile::SpoolFile(std::string output) : output_(std::move(output)), descriptor_(openUnnamedBeside(output_)) {
    if (descriptor_ < 0) failWriting(output_);
}

SpoolFile::~SpoolFile() {
    if (descriptor_ >= 0) closeFile(descriptor_);
}

void SpoolFile::append(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const std::size_t part = std::min(bytes.size(), kAtOnce);
        const std::ptrdiff_t done = writeSome(descriptor_, bytes.data(), part);
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
        const std::ptrdiff_t got = readAt(descriptor_, room.data(), room.size(), at);
        if (got <= 0) failWriting(output_);
        file.append({room.data(), static_cast<std::size_t>(got)});
        at += static_cast<std::uint64_t>(got);
    }
}

} // namespace pointrt
