// SPDX-License-Identifier: Apache-2.0
// GLFW without linking to it, as vulkan.h does with Vulkan: the viewer starts where there is none, and needs it for
// windows only.
#pragma once

#include "runtime/gpu/vulkan.h"

// The header declares the functions that take Vulkan types when these are known.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace pointrt {

/// Every function of GLFW 3.3 that is called; add a name here to use one more.
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
    X(glfwGetPhysicalDevicePresentationSupport)                                                                        \
    X(glfwGetRequiredInstanceExtensions)                                                                               \
    X(glfwGetWindowAttrib)                                                                                             \
    X(glfwGetWindowContentScale)                                                                                       \
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

/// The functions; the library is opened by the first call. Throws Error kCannotRun where there is none, or an older
/// one.
const Glfw& glfw();

} // namespace pointrt
