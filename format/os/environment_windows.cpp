// SPDX-License-Identifier: Apache-2.0
#include "format/os/environment.h"

#include "format/os/wide_path_windows.h"

#include <array>

namespace pointrt {

/// Reads the current value: the C library's getenv supports no UTF-8, and misses variables that the program has set
/// through another C library, as Python does.
std::string environmentVariable(const char* name) {
    std::array<wchar_t, 32768> value{}; // the longest variable
    const DWORD length =
        GetEnvironmentVariableW(format::widePath(name).c_str(), value.data(), static_cast<DWORD>(value.size()));
    return length < value.size() ? format::narrowPath({value.data(), length}) : std::string();
}

} // namespace pointrt
