// SPDX-License-Identifier: Apache-2.0
#include "format/os/desktop.h"

#include "format/os/wide_path_windows.h"

namespace pointrt {

bool hasDesktop() { return true; }

std::vector<std::string> interfaceFonts() {
    std::wstring windows(MAX_PATH, 0); // the API's own limit for this folder
    windows.resize(GetSystemWindowsDirectoryW(windows.data(), MAX_PATH));
    const std::string folder = format::narrowPath(windows) + "\\Fonts\\";
    return {folder + "segoeui.ttf", folder + "tahoma.ttf", folder + "arial.ttf"};
}

} // namespace pointrt
