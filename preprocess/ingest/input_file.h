// SPDX-License-Identifier: GPL-3.0-or-later
// An input file as a block of bytes.
#pragma once

#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>

#include "format/base/error.h"

namespace pointrt {

/// The bytes of one input, valid as long as the InputFile (or a move of it) lives.
struct InputFile {
    std::string name;       ///< for messages: the path, or "standard input"
    std::string_view bytes; ///< decompressed, if the file was gzip-compressed
    std::shared_ptr<const void> owner;
    bool mapped = false; ///< the bytes are the mapped file, not a copy

    const char* begin() const { return bytes.data(); }
    const char* end() const { return bytes.data() + bytes.size(); }
};

/// Whether the user or a file named an input. A user may name a pipe; a file may only name regular files, since a pipe
/// would block.
enum class NamedBy { kUser, kFile };

/// Maps or reads path ("-" is standard input) and decompresses gzip.
/// Throws Error: no such file, a directory, a device, no permission, empty, invalid or too large gzip (unpackGzip).
InputFile openInputFile(const std::string& path, NamedBy named_by = NamedBy::kUser);

/// Releases the memory of the first `bytes` bytes of a mapped file; they are read again if accessed.
void releasePages(const InputFile& input, std::uint64_t bytes);

/// For readers that go through an input once: releases, from time to time, the pages that they have read.
struct ReleasePagesBehind {
    const InputFile& input;
    std::uint64_t kept_from = 0; ///< bytes before it are released

    /// done: number of bytes read
    void operator()(std::uint64_t done) {
        // small compared with the memory of a bake, but large enough for few calls
        constexpr std::uint64_t kStep = 8 << 20;
        if (done > kept_from + kStep) releasePages(input, kept_from = done);
    }
};

/// Throws Error{kBadInput, "name: reason"}.
[[noreturn]] void refuse(const InputFile& input, const std::string& reason);

/// Throws Error{kBadInput, "name:place: reason"}.
[[noreturn]] void refuseAt(const InputFile& input, const std::string& place, const std::string& reason);

/// As refuseAt; the place is the number of the line that contains `at`.
[[noreturn]] void refuseLine(const InputFile& input, const char* at, const std::string& reason);

/// Quotes bytes of a file for a one-line message: shortened, without control characters.
std::string inQuotes(std::string_view text);

/// Adds a name in quotes to a list for a message, unless the list fills about a line already.
void addQuoted(std::string_view name, std::string& list);

} // namespace pointrt
