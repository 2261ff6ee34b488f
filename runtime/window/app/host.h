// SPDX-License-Identifier: Apache-2.0
// Where frames go and input comes from: a window of the desktop, or memory alone.
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
    std::string device; ///< as in DeviceRequest
    bool verbose = false;
    bool offscreen = false;                   ///< no window: nothing is shown, and input comes from elsewhere
    std::uint32_t width = 1280, height = 720; ///< window units
    double scale = 1;                         ///< pixels in a window unit, where there is no window to tell
    std::string title;
};

/// Owns window, device and presenter, and frees them in order.
class Host {
public:
    /// Throws Error kCannotRun where there is no GLFW, display, driver or device.
    explicit Host(const HostRequest& request);
    ~Host();
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    Device& device() { return device_; }
    Presenter& presenter() { return presenter_; }
    ResizeEvent size() const { return size_; }
    /// Of the picture, at least 1 x 1; the last one while minimised.
    PixelSize pixels() const { return pixels_; }
    bool minimised() const { return size_.width == 0 || size_.height == 0; }
    /// How large the user wants text: 1 on ordinary screens.
    float textScale() const;

    /// What the user did, waiting up to so long for something.
    std::vector<InputEvent> poll(double timeout_s);
    /// Input from elsewhere may change the size: the window follows.
    void resize(const ResizeEvent& size);

    std::string clipboard();
    void setClipboard(const std::string& text);
    void setTitle(const std::string& title);
    void setCursor(CursorShape shape);
    void useClipboardForUi();

private:
    void applySize(const ResizeEvent& size);

    std::optional<PlatformWindow> desktop_;
    Device device_;
    Presenter presenter_;
    ResizeEvent size_;
    PixelSize pixels_;
    std::string memory_clipboard_;
};

} // namespace pointrt
