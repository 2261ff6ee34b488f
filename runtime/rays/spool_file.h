// SPDX-License-Identifier: Apache-2.0
// Bytes that wait on disk until it is known what goes before them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "runtime/util/output_file.h"

namespace pointrt {

/// A file without a name, in the folder of the output that it is for, so that it needs no other disk. It is gone with
/// the object, whatever ends the process. Each function throws Error kCannotWrite "OUTPUT: reason".
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
    /// Appends all of them to file.
    void copyTo(OutputFile& file) const;

private:
    std::string output_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    std::uint32_t checksum_ = 0;
};

} // namespace pointrt
