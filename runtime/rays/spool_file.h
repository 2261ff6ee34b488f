// SPDX-License-Identifier: Apache-2.0
// A temporary file for bytes whose header is not known yet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "runtime/util/output_file.h"

namespace pointrt {

/// An unnamed file in the folder of the output, so on the same disk. The system deletes it with the object or the
/// process. Every function throws Error kCannotWrite "OUTPUT: reason".
class SpoolFile {
public:
    explicit SpoolFile(std::string output);
    ~SpoolFile();
    SpoolFile(const SpoolFile&) = delete;
    SpoolFile& operator=(const SpoolFile&) = delete;

    void append(std::span<const std::byte> bytes);
    std::uint64_t size() const { return size_; }
    /// CRC-32 of all bytes, as in zip files.
    std::uint32_t checksum() const { return checksum_; }
    /// Appends all bytes to file.
    void copyTo(OutputFile& file) const;

private:
    std::string output_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    std::uint32_t checksum_ = 0;
};

} // namespace pointrt
