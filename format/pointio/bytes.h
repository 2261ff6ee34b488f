// SPDX-License-Identifier: Apache-2.0
// Little-endian numbers in the bytes of a file.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "format/base/error.h"
#include "format/base/printable.h"

namespace pointrt {

static_assert(std::endian::native == std::endian::little, "numbers are read without conversion");

/// The number at `at`, which must lie in bytes.
template <typename Number>
Number loadAt(std::string_view bytes, std::size_t at) {
    static_assert(std::is_arithmetic_v<Number>);
    Number number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// bytes[at, at + size), cut off at the end of bytes.
inline std::string_view cut(std::string_view bytes, std::uint64_t at, std::uint64_t size) {
    return at > bytes.size() ? std::string_view{} : bytes.substr(at, size);
}

/// Whether [at, at + size) lies in [0, bytes).
inline bool liesIn(std::uint64_t at, std::uint64_t size, std::uint64_t bytes) {
    return at <= bytes && size <= bytes - at;
}

/// The text of a field of fixed length, up to the first 0.
inline std::string fieldText(std::string_view field) { return std::string(field.substr(0, field.find('\0'))); }

/// Throws Error kBadInput without the file's name, which the reader adds. Escapes reason, as messages of libraries may
/// quote bytes of the file.
[[noreturn]] inline void refuseFile(const std::string& reason) {
    throw Error(ExitCode::kBadInput, printable(reason, reason.size()));
}

} // namespace pointrt
