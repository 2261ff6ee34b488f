// SPDX-License-Identifier: Apache-2.0
// GLFW, loaded at run time like Vulkan (vulkan.h): the viewer starts without it and needs it only for windows.
#pragma once

#include "runtime/gpu/vulkan.h"

// Included after Vulkan's types, so that GLFW declares the functions that take them.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace pointrt {

/// All functions of GLFW 3.3 in use; add a name here to use another one.
#define POINTRT_GLFW_FUNCTIONS(X)                                                                                      \
    X(glfwCreateStandardCursor)                                                                                        \
    X(glfwCreateWindow)                                                                                                \
    X(glfwCreateWindowSurface)                                                                                         \
    X(glfwDestroyCursor)                                                                                               \
    X(glfwDestroyWindow)                                                                                               \
    X(glfwGetClipboardString)                                                                                          \
    X(glfwGetError)                                                                                                    \
    X(glfwGetFramebufferSize)                                                                                          \
    X(glfwGetKeyName)                                                                                                  \
    X(glfwGetMonitorPos)                                                                                               \
    X(glfwGetMonitors)                                                                                                 \
    X(glfwGetPhysicalDevicePresentationSupport)                                                                        \
    X(glfwGetPrimaryMonitor)                                                                                           \
    X(glfwGetRequiredInstanceExtensions)                                                                               \
    X(glfwGetVideoMode)                                                                                                \
    X(glfwGetWindowAttrib)                                                                                             \
    X(glfwGetWindowContentScale)                                                                                       \
    X(glfwGetWindowPos)                                                                                                \
    X(glfwGetWindowSize)                                                                                               \
    X(glfwGetWindowUserPointer)                                                                                        \
    X(glfwInit)                                                                                                        \
    X(glfwPollEvents)                                                                                                  \
    X(glfwPostEmptyEvent)                                                                                              \
    X(glfwSetCharCallback)                                                                                             \
    X(glfwSetClipboardString)                                                                                          \
    X(glfwSetCursor)                                                                                                   \
    X(glfwSetCursorPosCallback)                                                                                        \
    X(glfwSetDropCallback)                                                                                             \
    X(glfwSetFramebufferSizeCallback)                                                                                  \
    X(glfwSetKeyCallback)                                                                                              \
    X(glfwSetMouseButtonCallback)                                                                                      \
    X(glfwSetScrollCallback)                                                                                           \
    X(glfwSetWindowCloseCallback)                                                                                      \
    X(glfwSetWindowContentScaleCallback)                                                                               \
    X(glfwSetWindowIconifyCallback)                                                                                    \
    X(glfwSetWindowPosCallback)                                                                                        \
    X(glfwSetWindowSize)                                                                                               \
    X(glfwSetWindowTitle)                                                                                              \
    X(glfwSetWindowUserPointer)                                                                                        \
    X(glfwTerminate)                                                                                                   \
    X(glfwVulkanSupported)                                                                                             \
    X(glfwWaitEventsTimeout)                                                                                           \
    X(glfwWindowHint)

struct Glfw {
#define POINTRT_DECLARE_GLFW(name) decltype(&::name) name = nullptr;
    POINTRT_GLFW_FUNCTIONS(POINTRT_DECLARE_GLFW)
#undef POINTRT_DECLARE_GLFW
};

/// The functions. The first call loads the library. Throws Error kCannotRun if it is missing or too old.
const Glfw& glfw();

} // namespace pointrt
