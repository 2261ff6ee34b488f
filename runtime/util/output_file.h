// SPDX-License-Identifier: Apache-2.0
// Atomically written files, with errors as exceptions.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>

#include "format/os/atomic_file.h"

namespace pointrt {

/// How an existing file is replaced.
enum class Writing {
    kWhole,  ///< atomically, by a new file, once everything is written
    kInPlace ///< overwritten piece by piece: another process has it open and reads pieces as they arrive
};

/// A file written in pieces. The path "-" is standard output, which gets each piece at once. Each function throws Error
/// kCannotWrite "PATH: reason".
class OutputFile {
public:
    explicit OutputFile(std::string path, Writing writing = Writing::kWhole);

    void append(std::span<const std::uint8_t> bytes);
    /// Replaces bytes that were appended before, from offset on. Not for standard output or kInPlace.
    void overwrite(std::uint64_t offset, std::span<const std::uint8_t> bytes);
    void commit();

private:
    struct Close {
        void operator()(std::FILE* stream) const;
    };

    void require(bool done) const;

    std::string path_;
    format::AtomicFile file_;
    std::unique_ptr<std::FILE, Close> stream_; ///< standard output, in place of file_
};

/// Writes bytes atomically to path: on failure an existing file is unchanged.
/// Throws Error kCannotWrite "PATH: reason".
void writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

/// Throws Error kCannotWrite if writeFile is sure to fail: the folder is missing or read-only, or path is not a file.
/// Call it before long work.
void requireWritable(const std::string& path);

} // namespace pointrt
