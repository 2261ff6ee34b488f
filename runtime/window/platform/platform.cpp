// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/platform.h"

#include <type_traits>
#include <utility>

#include "format/base/error.h"
#include "runtime/util/on_error.h"
#include "runtime/window/platform/glfw.h"
#include "runtime/window/platform/key_names.h"

namespace pointrt {
namespace {

std::string lastError() {
    const char* text = nullptr;
    glfw().glfwGetError(&text);
    return text ? text : "unknown reason";
}

[[noreturn]] void failWithoutWindow(const std::string& reason) {
    throw Error{ExitCode::kCannotRun, "cannot open a window: " + reason + "; render without one with -o FILE"};
}

PlatformInbox& inboxOf(GLFWwindow* window) {
    return *static_cast<PlatformInbox*>(glfw().glfwGetWindowUserPointer(window));
}

/// Appends event; if the last event is superseded by it, replaces that one.
template <typename Event>
void push(GLFWwindow* window, Event event) {
    constexpr bool kOvertakes = std::is_same_v<Event, CursorEvent> || std::is_same_v<Event, ResizeEvent>;
    std::vector<InputEvent>& events = inboxOf(window).events;
    if (kOvertakes && !events.empty() && std::holds_alternative<Event>(events.back()))
        events.back() = std::move(event);
    else
        events.emplace_back(std::move(event));
}

ResizeEvent sizeOf(GLFWwindow* window) {
    int width = 0, height = 0, pixel_width = 0, pixel_height = 0;
    glfw().glfwGetWindowSize(window, &width, &height);
    glfw().glfwGetFramebufferSize(window, &pixel_width, &pixel_height);
    ResizeEvent size;
    if (width > 0) size.scale = static_cast<double>(pixel_width) / width;
    if (glfw().glfwGetWindowAttrib(window, GLFW_ICONIFIED) || pixel_width <= 0 || pixel_height <= 0) return size;
    size.width = static_cast<std::uint32_t>(width);
    size.height = static_cast<std::uint32_t>(height);
    return size;
}

void onKey(GLFWwindow* window, int key, int scancode, int action, int) {
    const char* name = key == GLFW_KEY_UNKNOWN ? nullptr : glfw().glfwGetKeyName(key, scancode);
    const Key ours = keyFromGlfw(key, name);
    if (ours != Key::kUnknown) push(window, KeyEvent{ours, action != GLFW_RELEASE});
}

void onButton(GLFWwindow* window, int button, int action, int) {
    constexpr std::pair<int, MouseButton> kButtons[] = {{GLFW_MOUSE_BUTTON_LEFT, MouseButton::kLeft},
                                                        {GLFW_MOUSE_BUTTON_RIGHT, MouseButton::kRight},
                                                        {GLFW_MOUSE_BUTTON_MIDDLE, MouseButton::kMiddle}};
    for (const auto& [theirs, ours] : kButtons)
        if (theirs == button) push(window, ButtonEvent{ours, action == GLFW_PRESS});
}

void onDrop(GLFWwindow* window, int count, const char** paths) {
    push(window, DropEvent{std::vector<std::string>(paths, paths + count)});
}

/// Also sent for iconification and changes of scale, which are in the event.
void onSize(GLFWwindow* window) { push(window, sizeOf(window)); }

void setCallbacks(GLFWwindow* window) {
    const Glfw& g = glfw();
    g.glfwSetKeyCallback(window, onKey);
    g.glfwSetMouseButtonCallback(window, onButton);
    g.glfwSetDropCallback(window, onDrop);
    g.glfwSetCharCallback(window, [](GLFWwindow* w, unsigned code_point) { push(w, TextEvent{code_point}); });
    g.glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { push(w, CursorEvent{x, y}); });
    g.glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) { push(w, WheelEvent{x, y}); });
    g.glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { push(w, CloseEvent{}); });
    g.glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { onSize(w); });
    g.glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { onSize(w); });
    g.glfwSetWindowPosCallback(window, [](GLFWwindow* w, int, int) { inboxOf(w).moved = true; });
    g.glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { onSize(w); });
}

/// The monitor under the window's middle, or the primary one: Wayland does not report where windows are.
GLFWmonitor* monitorUnder(GLFWwindow* window) {
    int x = 0, y = 0, width = 0, height = 0, count = 0;
    glfw().glfwGetWindowPos(window, &x, &y);
    glfw().glfwGetWindowSize(window, &width, &height);
    x += width / 2;
    y += height / 2;
    GLFWmonitor** monitors = glfw().glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        int left = 0, top = 0;
        glfw().glfwGetMonitorPos(monitors[i], &left, &top);
        const GLFWvidmode* mode = glfw().glfwGetVideoMode(monitors[i]);
        if (mode && x >= left && x < left + mode->width && y >= top && y < top + mode->height) return monitors[i];
    }
    return glfw().glfwGetPrimaryMonitor();
}

int glfwShape(CursorShape shape) {
    switch (shape) {
    case CursorShape::kText:
        return GLFW_IBEAM_CURSOR;
    case CursorShape::kHand:
        return GLFW_HAND_CURSOR;
    case CursorShape::kCross:
        return GLFW_CROSSHAIR_CURSOR;
    case CursorShape::kResizeX:
        return GLFW_HRESIZE_CURSOR;
    case CursorShape::kResizeY:
        return GLFW_VRESIZE_CURSOR;
    default:
        return GLFW_ARROW_CURSOR;
    }
}

} // namespace

PlatformWindow createPlatformWindow(std::uint32_t width, std::uint32_t height, const std::string& title) {
    const Glfw& g = glfw();
    if (!g.glfwInit()) failWithoutWindow(lastError());
    PlatformWindow window;
    const OnError undo([&] { destroyPlatformWindow(window); });
    if (!g.glfwVulkanSupported()) failWithoutWindow("no Vulkan driver for this display (" + lastError() + ")");
    g.glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window.handle =
        g.glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr);
    if (!window.handle) failWithoutWindow(lastError());
    window.inbox = std::make_unique<PlatformInbox>();
    g.glfwSetWindowUserPointer(window.handle, window.inbox.get());
    setCallbacks(window.handle);
    return window;
}

void destroyPlatformWindow(PlatformWindow& window) {
    for (GLFWcursor* cursor : window.cursors)
        if (cursor) glfw().glfwDestroyCursor(cursor);
    if (window.handle) glfw().glfwDestroyWindow(window.handle);
    glfw().glfwTerminate();
    window = {};
}

std::vector<InputEvent> pollEvents(PlatformWindow& window, double timeout_seconds) {
    if (timeout_seconds > 0)
        glfw().glfwWaitEventsTimeout(timeout_seconds);
    else
        glfw().glfwPollEvents();
    return std::exchange(window.inbox->events, {});
}

void wakePlatform() { glfw().glfwPostEmptyEvent(); }

ResizeEvent windowSize(const PlatformWindow& window) { return sizeOf(window.handle); }

PixelSize framebufferSize(const PlatformWindow& window) {
    int width = 0, height = 0;
    glfw().glfwGetFramebufferSize(window.handle, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

float contentScale(const PlatformWindow& window) {
    float x = 1, y = 1;
    glfw().glfwGetWindowContentScale(window.handle, &x, &y);
    return x > 0 ? x : 1;
}

std::optional<double> refreshRate(const PlatformWindow& window) {
    GLFWmonitor* monitor = monitorUnder(window.handle);
    const GLFWvidmode* mode = monitor ? glfw().glfwGetVideoMode(monitor) : nullptr;
    return mode && mode->refreshRate > 0 ? std::optional<double>(mode->refreshRate) : std::nullopt;
}

bool isMinimised(const PlatformWindow& window) { return windowSize(window).width == 0; }

void setTitle(PlatformWindow& window, const std::string& title) {
    glfw().glfwSetWindowTitle(window.handle, title.c_str());
}

void setSize(PlatformWindow& window, std::uint32_t width, std::uint32_t height) {
    glfw().glfwSetWindowSize(window.handle, static_cast<int>(width), static_cast<int>(height));
}

void setCursor(PlatformWindow& window, CursorShape shape) {
    if (window.cursor == shape) return;
    GLFWcursor*& cursor = window.cursors[static_cast<std::size_t>(shape)];
    // null, for shapes that the theme does not have, is the arrow
    if (!cursor) cursor = glfw().glfwCreateStandardCursor(glfwShape(shape));
    glfw().glfwSetCursor(window.handle, cursor);
    window.cursor = shape;
}

std::string clipboardText(PlatformWindow& window) {
    const char* text = glfw().glfwGetClipboardString(window.handle);
    return text ? text : "";
}

void setClipboardText(PlatformWindow& window, const std::string& text) {
    glfw().glfwSetClipboardString(window.handle, text.c_str());
}

void requestPresentation(const PlatformWindow&, DeviceRequest& request) {
    std::uint32_t count = 0;
    const char** names = glfw().glfwGetRequiredInstanceExtensions(&count);
    if (!names) failWithoutWindow("Vulkan cannot present to this display (" + lastError() + ")");
    request.graphics = true;
    request.instance_extensions.assign(names, names + count);
    request.can_present = [](VkInstance instance, VkPhysicalDevice physical, std::uint32_t family) {
        return glfw().glfwGetPhysicalDevicePresentationSupport(instance, physical, family) == GLFW_TRUE;
    };
}

VkSurfaceKHR createSurface(PlatformWindow& window, const Device& device) {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    check(glfw().glfwCreateWindowSurface(device.instance, window.handle, nullptr, &surface),
          "create a surface for the window");
    return surface;
}

} // namespace pointrt
