// SPDX-License-Identifier: Apache-2.0
#include "format/os/desktop.h"

#include <cstdlib>

namespace pointrt {
namespace {

bool isSet(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value != '\0';
}

} // namespace

bool hasDesktop() { return isSet("DISPLAY") || isSet("WAYLAND_DISPLAY"); }

std::vector<std::string> interfaceFonts() {
    // of Debian, Fedora and Arch
    return {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
            "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
            "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};
}

} // namespace pointrt
