// SPDX-License-Identifier: Apache-2.0
#include "format/os/desktop.h"

#include "format/os/environment.h"

namespace pointrt {

bool hasDesktop() { return !environmentVariable("DISPLAY").empty() || !environmentVariable("WAYLAND_DISPLAY").empty(); }

std::vector<std::string> interfaceFonts() {
    // folders of Debian, Fedora and Arch
    return {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
            "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
            "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};
}

} // namespace pointrt
