// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all, with the errors of the tools.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "format/base/atomic_file.h"

namespace pointrt {

/// A file that is written in pieces and has its name when all of them are there: what was there stays until then.
/// The path "-" is standard output, which gets the pieces as they come.
/// Each function throws Error kCannotWrite "PATH: reason".
class OutputFile {
public:
    explicit OutputFile(std::string path);

    void append(std::span<const std::uint8_t> bytes);
    /// In place of those at offset, which are there already; of a file only.
    void overwrite(std::uint64_t offset, std::span<const std::uint8_t> bytes);
    void commit();

private:
    bool isFile() const { return path_ != "-"; }
    void require(bool done) const;

    std::string path_;
    format::AtomicFile file_;
};

/// Writes bytes to path, replacing what is there; a failure leaves what was there.
/// Throws Error kCannotWrite "PATH: reason".
void writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

/// Throws Error kCannotWrite where writeFile is sure to fail: the folder is missing or read-only, or path is no file.
/// To be asked before long work.
void requireWritable(const std::string& path);

} // namespace pointrt
