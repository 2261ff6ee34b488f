// SPDX-License-Identifier: Apache-2.0
// Makes the C library's functions take file names in UTF-8. The linker substitutes these for the functions of
// msvcrt.dll (--wrap), also in libstdc++ and libpng, which are linked statically.
// - mbrtowc, with which std::filesystem::path of libstdc++ converts names to wide characters, does not support UTF-8 in
//   msvcrt.dll, whatever the code page of the process.
// - fopen takes names in the code page of the process. The tools' manifest sets that to UTF-8, but a library uses the
//   code page of the program that loads it, and Python's is the system's.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cwchar>
#include <string>

#include "format/os/wide_path_windows.h"

namespace {

constexpr auto kInvalid = static_cast<std::size_t>(-1);

/// The length of a character that begins with this byte, which may still be invalid.
std::size_t lengthFrom(unsigned char lead) { return lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4; }

} // namespace

/// For a character outside the basic plane, the first call reads all bytes but the last, and the second call the last.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t bytes, std::mbstate_t* state) {
    static thread_local std::mbstate_t own_state = 0;
    std::mbstate_t& second_unit = state ? *state : own_state;
    if (!from || bytes == 0) return second_unit = 0;
    wchar_t unit = static_cast<wchar_t>(second_unit);
    std::size_t read = 1;
    second_unit = 0;
    if (unit == 0) {
        const std::size_t length = lengthFrom(static_cast<unsigned char>(*from));
        const std::wstring units = pointrt::format::widePath({from, std::min(length, bytes)});
        if (units.empty()) {
            errno = EILSEQ;
            return kInvalid;
        }
        unit = units[0];
        if (units.size() == 2) second_unit = units[1];
        read = length - (units.size() - 1);
    }
    if (to) *to = unit;
    return unit == 0 ? 0 : read;
}

extern "C" std::FILE* __wrap_fopen(const char* path, const char* mode) {
    return _wfopen(pointrt::format::widePath(path).c_str(), pointrt::format::widePath(mode).c_str());
}

/// The name by which libstdc++ calls fopen.
extern "C" std::FILE* __wrap_fopen64(const char* path, const char* mode) { return __wrap_fopen(path, mode); }
