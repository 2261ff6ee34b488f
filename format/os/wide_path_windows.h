// SPDX-License-Identifier: Apache-2.0
// UTF-8 paths and errors for the Windows API.
#pragma once

#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

#include <string>
#include <system_error>

namespace pointrt::format {

/// Empty if path is not UTF-8.
inline std::wstring widePath(const std::string& path) {
    const int bytes = static_cast<int>(path.size());
    const int length = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path.data(), bytes, nullptr, 0);
    std::wstring wide(static_cast<std::size_t>(length), 0);
    MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path.data(), bytes, wide.data(), length);
    return wide;
}

/// The path in UTF-8. Unpaired surrogates, which Windows allows in names, become U+FFFD.
inline std::string narrowPath(const std::wstring& wide) {
    const int units = static_cast<int>(wide.size());
    const int length = WideCharToMultiByte(CP_UTF8, 0, wide.data(), units, nullptr, 0, nullptr, nullptr);
    std::string path(static_cast<std::size_t>(length), 0);
    WideCharToMultiByte(CP_UTF8, 0, wide.data(), units, path.data(), length, nullptr, nullptr);
    return path;
}

inline std::string windowsReason(DWORD error) { return std::system_category().message(static_cast<int>(error)); }

} // namespace pointrt::format
