// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/app/host.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "runtime/window/ui/ui_input.h"

namespace pointrt {
namespace {

PixelSize pixelsOf(const ResizeEvent& size) {
    const auto scaled = [&](std::uint32_t units) {
        return std::max(1u, static_cast<std::uint32_t>(std::lround(units * size.scale)));
    };
    return {scaled(size.width), scaled(size.height)};
}

} // namespace

Host::Host(const HostRequest& request) {
    DeviceRequest device{request.device, request.verbose, true, {}, {}};
    device.traversal = request.traversal;
    try {
        if (!request.offscreen) {
            desktop_ = createPlatformWindow(request.width, request.height, request.title);
            requestPresentation(*desktop_, device);
        }
        device_ = createDevice(device);
        size_ = desktop_ ? windowSize(*desktop_) : ResizeEvent{request.width, request.height, request.scale};
        pixels_ = pixelsOf(size_);
        const VkSurfaceKHR surface = desktop_ ? createSurface(*desktop_, device_) : VK_NULL_HANDLE;
        presenter_ = createPresenter(device_, surface, pixels_.width, pixels_.height);
    } catch (...) {
        if (device_.handle) destroyDevice(device_);
        if (desktop_) destroyPlatformWindow(*desktop_);
        throw;
    }
}

Host::~Host() {
    destroyPresenter(device_, presenter_);
    destroyDevice(device_);
    if (desktop_) destroyPlatformWindow(*desktop_);
}

float Host::textScale() const { return desktop_ ? contentScale(*desktop_) : static_cast<float>(size_.scale); }

std::vector<InputEvent> Host::poll(double timeout_s) {
    if (!desktop_) {
        if (timeout_s > 0) std::this_thread::sleep_for(std::chrono::duration<double>(timeout_s));
        return {};
    }
    std::vector<InputEvent> events = pollEvents(*desktop_, timeout_s);
    findDisplay();
    for (const InputEvent& event : events)
        if (const auto* size = std::get_if<ResizeEvent>(&event)) applySize(*size);
    return events;
}

/// Queries the position only after the window was placed or moved, since that takes a round trip to the display.
void Host::findDisplay() {
    if (std::exchange(desktop_->inbox->moved, false)) display_hz_ = refreshRate(*desktop_);
}

void Host::resize(const ResizeEvent& size) {
    // the desktop reports the actual size in an event
    if (desktop_ && size.width > 0 && size.height > 0) return pointrt::setSize(*desktop_, size.width, size.height);
    if (!desktop_) applySize(size);
}

void Host::applySize(const ResizeEvent& size) {
    size_ = size;
    if (minimised()) return;
    pixels_ = pixelsOf(size_);
    resizeCanvas(device_, presenter_, pixels_.width, pixels_.height);
}

std::string Host::clipboard() { return desktop_ ? clipboardText(*desktop_) : memory_clipboard_; }

void Host::setClipboard(const std::string& text) {
    if (desktop_) return setClipboardText(*desktop_, text);
    memory_clipboard_ = text;
}

void Host::setTitle(const std::string& title) {
    if (desktop_) pointrt::setTitle(*desktop_, title);
}

void Host::setCursor(CursorShape shape) {
    if (desktop_) pointrt::setCursor(*desktop_, shape);
}

void Host::useClipboardForUi() {
    if (desktop_) useClipboard(*desktop_);
}

} // namespace pointrt
