// SPDX-License-Identifier: Apache-2.0
// A desktop window or an offscreen target: device, presentation, input and clipboard.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/window/input/events.h"
#include "runtime/window/platform/platform.h"
#include "runtime/window/platform/presenter.h"

namespace pointrt {

struct HostRequest {
    std::string device; ///< see DeviceRequest
    Traversal traversal = Traversal::kWalk;
    bool verbose = false;
    bool offscreen = false;                   ///< no window; input comes from a replay
    std::uint32_t width = 1280, height = 720; ///< window units
    double scale = 1;                         ///< pixels per window unit when offscreen
    std::string title;
};

/// Owns the window, the device and the presenter, and destroys them in order.
class Host {
public:
    /// Throws Error kCannotRun if GLFW, a display, a driver or a device is missing.
    explicit Host(const HostRequest& request);
    ~Host();
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    Device& device() { return device_; }
    Presenter& presenter() { return presenter_; }
    ResizeEvent size() const { return size_; }
    /// Size of the picture, at least 1 x 1; while minimised, the last size.
    PixelSize pixels() const { return pixels_; }
    bool minimised() const { return size_.width == 0 || size_.height == 0; }
    /// Text scale of the desktop: 1 on ordinary screens.
    float textScale() const;

    /// Refresh rate in Hz of the display that the window is on, if known.
    std::optional<double> displayRate() const { return display_hz_; }

    /// New events, waiting up to timeout_s for the first one.
    std::vector<InputEvent> poll(double timeout_s);
    /// Resizes the window to a replayed size.
    void resize(const ResizeEvent& size);

    std::string clipboard();
    void setClipboard(const std::string& text);
    void setTitle(const std::string& title);
    void setCursor(CursorShape shape);
    void useClipboardForUi();

private:
    void applySize(const ResizeEvent& size);
    void findDisplay();

    std::optional<PlatformWindow> desktop_;
    Device device_;
    Presenter presenter_;
    ResizeEvent size_;
    PixelSize pixels_;
    std::optional<double> display_hz_;
    std::string memory_clipboard_;
};

} // namespace pointrt
