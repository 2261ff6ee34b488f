// SPDX-License-Identifier: Apache-2.0
// A desktop window (X11, Wayland or Windows, through GLFW): input, clipboard, cursor and a Vulkan surface. Main thread
// only, except wakePlatform.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/util/pixel_size.h"
#include "runtime/window/input/events.h"

struct GLFWwindow;
struct GLFWcursor;

namespace pointrt {

enum class CursorShape : std::uint8_t { kArrow, kText, kHand, kCross, kResizeX, kResizeY };
constexpr std::size_t kCursorShapes = 6;

/// Events collected by the window's callbacks until the next poll.
struct PlatformInbox {
    std::vector<InputEvent> events;
    bool moved = true; ///< the window may be on another monitor
};

struct PlatformWindow {
    GLFWwindow* handle = nullptr;
    std::unique_ptr<PlatformInbox> inbox; ///< on the heap: the callbacks hold its address
    std::array<GLFWcursor*, kCursorShapes> cursors{};
    CursorShape cursor = CursorShape::kArrow;
};

/// Opens a window of width x height window units. Throws Error kCannotRun if GLFW, a display, or Vulkan support for it
/// is missing. One window at a time.
PlatformWindow createPlatformWindow(std::uint32_t width, std::uint32_t height, const std::string& title);
/// Destroy its surface first.
void destroyPlatformWindow(PlatformWindow& window);

/// Events since the last call. Waits up to timeout_seconds for the first one (0: does not wait). Merges consecutive
/// cursor movements and size changes.
std::vector<InputEvent> pollEvents(PlatformWindow& window, double timeout_seconds = 0);
/// Ends the wait in pollEvents. From any thread, while a window exists.
void wakePlatform();

/// The size as an event, 0 x 0 while minimised. pollEvents does not report the initial size.
ResizeEvent windowSize(const PlatformWindow& window);
/// The size in pixels, even while minimised.
PixelSize framebufferSize(const PlatformWindow& window);
/// The desktop's text scale: 1 on ordinary screens, about 2 on HiDPI. Not the ratio of pixels to window units, which is
/// always 1 on X11.
float contentScale(const PlatformWindow& window);
/// Refresh rate in Hz of the monitor under the window's middle, else of the primary one; none if unknown.
std::optional<double> refreshRate(const PlatformWindow& window);
bool isMinimised(const PlatformWindow& window);

void setTitle(PlatformWindow& window, const std::string& title);
void setSize(PlatformWindow& window, std::uint32_t width, std::uint32_t height);
void setCursor(PlatformWindow& window, CursorShape shape);

/// Empty if the clipboard holds no text.
std::string clipboardText(PlatformWindow& window);
void setClipboardText(PlatformWindow& window, const std::string& text);

/// Adds to request what presenting to window needs: extensions, graphics, and a queue that can present.
void requestPresentation(const PlatformWindow& window, DeviceRequest& request);
/// Throws Error kCannotRun if the driver fails. createPresenter takes ownership.
VkSurfaceKHR createSurface(PlatformWindow& window, const Device& device);

} // namespace pointrt
