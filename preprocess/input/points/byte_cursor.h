// SPDX-License-Identifier: GPL-3.0-or-later
// Takes little-endian values from a block of bytes, none of which may be missing.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

struct ByteCursor {
    const InputFile& input; ///< for messages
    std::string_view rest;

    std::string_view takeBytes(std::uint64_t count) {
        if (count > rest.size()) refuse(input, "truncated: it ends within a record");
        const std::string_view bytes = rest.substr(0, count);
        rest.remove_prefix(count);
        return bytes;
    }
    /// `count` elements of `size` bytes each.
    std::string_view takeArray(std::uint64_t count, std::uint64_t size) {
        if (count > rest.size() / size) refuse(input, "truncated: it ends within a record");
        return takeBytes(count * size);
    }
    template <typename Value>
    Value take() {
        Value value;
        std::memcpy(&value, takeBytes(sizeof value).data(), sizeof value);
        return value;
    }
    /// The bytes up to the mark, which is skipped.
    std::string_view takeUntil(char mark) {
        const std::size_t length = rest.find(mark);
        if (length == std::string_view::npos) refuse(input, "truncated: it ends within a string");
        const std::string_view text = takeBytes(length);
        rest.remove_prefix(1);
        return text;
    }
    /// A length of 32 bits, followed by that many bytes.
    std::string_view takeText() { return takeBytes(take<std::uint32_t>()); }
};

} // namespace pointrt
