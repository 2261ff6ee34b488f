// SPDX-License-Identifier: GPL-3.0-or-later
// One input file as a block of bytes.
#pragma once

#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>

#include "format/base/error.h"

namespace pointrt {

/// The bytes of one input, valid as long as the Source (or a move of it) lives.
struct Source {
    std::string name;       ///< as in messages: the path, or "standard input"
    std::string_view bytes; ///< unpacked when the file was gzip-compressed
    std::shared_ptr<const void> owner;
    bool mapped = false; ///< the bytes are those of the file, not a copy

    const char* begin() const { return bytes.data(); }
    const char* end() const { return bytes.data() + bytes.size(); }
};

/// Who named an input. What a user names may be a pipe; what a file names must be a regular file, lest it be waited
/// for.
enum class NamedBy { kUser, kFile };

/// Maps or reads path ("-" is standard input) and unpacks gzip.
/// Throws Error: no such file, a directory, a device, no permission, empty, broken gzip or too much of it (unpackGzip).
Source openSource(const std::string& path, NamedBy named_by = NamedBy::kUser);

/// Takes the first bytes, so many of them, out of this process's memory, where they are in a file: they come back when
/// they are touched.
void letGo(const Source& source, std::uint64_t bytes);

/// letGo, now and then, of what lies behind a reader that goes through a source once.
struct LetGoBehind {
    const Source& source;
    std::uint64_t kept_from = 0; ///< bytes before that are gone

    /// done: so many bytes are read
    void operator()(std::uint64_t done) {
        constexpr std::uint64_t kStep = 8 << 20; // little beside what a bake takes, and few calls
        if (done > kept_from + kStep) letGo(source, kept_from = done);
    }
};

/// Throws Error{kBadInput, "name: reason"}.
[[noreturn]] void refuse(const Source& source, const std::string& reason);

/// Throws Error{kBadInput, "name:place: reason"}.
[[noreturn]] void refuseAt(const Source& source, const std::string& place, const std::string& reason);

/// As refuseAt, the place being the number of the line that holds `at`.
[[noreturn]] void refuseLine(const Source& source, const char* at, const std::string& reason);

/// Bytes of a file fit for a one-line message: cut short, without control characters, in quotes.
std::string inQuotes(std::string_view text);

} // namespace pointrt
