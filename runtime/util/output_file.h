// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all, with the errors of the tools.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>

#include "format/base/atomic_file.h"

namespace pointrt {

/// What becomes of a file that is there while another one is written.
enum class Writing {
    kWhole,  ///< it stays until all is there, and then is another file
    kInPlace ///< it gets the pieces as they come: somebody holds it open and waits for them
};

/// A file that is written in pieces. The path "-" is standard output, which gets them as they come.
/// Each function throws Error kCannotWrite "PATH: reason".
class OutputFile {
public:
    explicit OutputFile(std::string path, Writing writing = Writing::kWhole);

    void append(std::span<const std::uint8_t> bytes);
    /// In place of those at offset, which are there already; of a file that appears whole only.
    void overwrite(std::uint64_t offset, std::span<const std::uint8_t> bytes);
    void commit();

private:
    struct Close {
        void operator()(std::FILE* stream) const;
    };

    void require(bool done) const;

    std::string path_;
    format::AtomicFile file_;
    std::unique_ptr<std::FILE, Close> stream_; ///< in place of file_
};

/// Writes bytes to path, replacing what is there; a failure leaves what was there.
/// Throws Error kCannotWrite "PATH: reason".
void writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

/// Throws Error kCannotWrite where writeFile is sure to fail: the folder is missing or read-only, or path is no file.
/// To be asked before long work.
void requireWritable(const std::string& path);

} // namespace pointrt
