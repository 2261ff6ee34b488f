// SPDX-License-Identifier: Apache-2.0
#include "format/os/desktop.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace pointrt {
namespace {

TEST(Desktop, IsThereWithADisplay) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    EXPECT_FALSE(hasDesktop());
    setenv("DISPLAY", "", 1);
    EXPECT_FALSE(hasDesktop());
    setenv("DISPLAY", ":0", 1);
    EXPECT_TRUE(hasDesktop());
    unsetenv("DISPLAY");
    setenv("WAYLAND_DISPLAY", "wayland-0", 1);
    EXPECT_TRUE(hasDesktop());
}

TEST(Desktop, FontsAreOutlinesAtWholePaths) {
    ASSERT_FALSE(interfaceFonts().empty());
    for (const std::string& font : interfaceFonts()) {
        EXPECT_EQ(font.front(), '/') << font;
        EXPECT_TRUE(font.ends_with(".ttf")) << font;
    }
}

} // namespace
} // namespace pointrt
