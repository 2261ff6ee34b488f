// SPDX-License-Identifier: Apache-2.0
#include "format/os/environment.h"

#include "format/os/wide_path_windows.h"

#include <array>

namespace pointrt {

/// As it is now: the C library's getenv knows neither UTF-8 nor what the program has set by another C library, as
/// Python has.
std::string environmentVariable(const char* name) {
    std::array<wchar_t, 32768> value{}; // the longest variable
    const DWORD length =
        GetEnvironmentVariableW(format::widePath(name).c_str(), value.data(), static_cast<DWORD>(value.size()));
    return length < value.size() ? format::narrowPath({value.data(), length}) : std::string();
}

} // namespace pointrt
