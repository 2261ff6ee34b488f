// SPDX-License-Identifier: Apache-2.0
// A window of the desktop (X11 or Wayland, as GLFW gives them): input, clipboard, cursor and a Vulkan surface.
// All of it from the thread that runs main, but for wakePlatform.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
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

/// What a window's callbacks leave for the next poll.
struct PlatformInbox {
    std::vector<InputEvent> events;
};

struct PlatformWindow {
    GLFWwindow* handle = nullptr;
    std::unique_ptr<PlatformInbox> inbox; ///< at a fixed address, which the callbacks know
    std::array<GLFWcursor*, kCursorShapes> cursors{};
    CursorShape cursor = CursorShape::kArrow;
};

/// Opens a window of width x height window units. Throws Error kCannotRun with what is missing: GLFW, a display, or
/// Vulkan for it. One window at a time.
PlatformWindow createPlatformWindow(std::uint32_t width, std::uint32_t height, const std::string& title);
/// After its surface is destroyed.
void destroyPlatformWindow(PlatformWindow& window);

/// What happened since the last call, waiting up to timeout_seconds for something (0: not at all). Cursor movements and
/// sizes that the next event overtakes are left out.
std::vector<InputEvent> pollEvents(PlatformWindow& window, double timeout_seconds = 0);
/// Ends the wait of pollEvents. From any thread, while there is a window.
void wakePlatform();

/// The size as an event, 0 x 0 while minimised; the first size does not come by pollEvents.
ResizeEvent windowSize(const PlatformWindow& window);
/// The size in pixels, also while minimised.
PixelSize framebufferSize(const PlatformWindow& window);
/// How large the user wants text: 1 on ordinary screens, about 2 on HiDPI ones. Not the ratio of pixels to window
/// units: on X11 that is 1 on both.
float contentScale(const PlatformWindow& window);
bool isMinimised(const PlatformWindow& window);

void setTitle(PlatformWindow& window, const std::string& title);
void setSize(PlatformWindow& window, std::uint32_t width, std::uint32_t height);
void setCursor(PlatformWindow& window, CursorShape shape);

/// Empty when it holds no text.
std::string clipboardText(PlatformWindow& window);
void setClipboardText(PlatformWindow& window, const std::string& text);

/// Adds to request what a device for window takes: extensions, graphics, and a queue that reaches its display.
void requestPresentation(const PlatformWindow& window, DeviceRequest& request);
/// Throws Error kCannotRun where the driver refuses. createPresenter takes it over.
VkSurfaceKHR createSurface(PlatformWindow& window, const Device& device);

} // namespace pointrt
