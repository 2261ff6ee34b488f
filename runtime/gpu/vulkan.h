// SPDX-License-Identifier: Apache-2.0
// Vulkan functions without linking to the loader: it is opened at run time, so that --help works without it, and its
// absence gives a clear error instead of the dynamic linker's. Inside namespace pointrt the functions have their usual
// names.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>

#include <string>

#include "format/base/error.h"

namespace pointrt {

/// The device was lost, after a hang or a driver update: everything on it is gone, but a new device can be created.
struct DeviceLost : Error {
    using Error::Error;
};

/// Every core function that the viewer calls; to use another one, add its name here.
#define POINTRT_VULKAN_FUNCTIONS(X)                                                                                    \
    X(vkAllocateCommandBuffers)                                                                                        \
    X(vkAllocateDescriptorSets)                                                                                        \
    X(vkAllocateMemory)                                                                                                \
    X(vkBeginCommandBuffer)                                                                                            \
    X(vkBindBufferMemory)                                                                                              \
    X(vkBindImageMemory)                                                                                               \
    X(vkCmdBeginRenderPass)                                                                                            \
    X(vkCmdBindDescriptorSets)                                                                                         \
    X(vkCmdBindIndexBuffer)                                                                                            \
    X(vkCmdBindPipeline)                                                                                               \
    X(vkCmdBindVertexBuffers)                                                                                          \
    X(vkCmdBlitImage)                                                                                                  \
    X(vkCmdClearColorImage)                                                                                            \
    X(vkCmdCopyBuffer)                                                                                                 \
    X(vkCmdCopyBufferToImage)                                                                                          \
    X(vkCmdCopyImage)                                                                                                  \
    X(vkCmdCopyImageToBuffer)                                                                                          \
    X(vkCmdDispatch)                                                                                                   \
    X(vkCmdDispatchIndirect)                                                                                           \
    X(vkCmdDrawIndexed)                                                                                                \
    X(vkCmdEndRenderPass)                                                                                              \
    X(vkCmdFillBuffer)                                                                                                 \
    X(vkCmdPipelineBarrier)                                                                                            \
    X(vkCmdPushConstants)                                                                                              \
    X(vkCmdResetQueryPool)                                                                                             \
    X(vkCmdSetScissor)                                                                                                 \
    X(vkCmdSetViewport)                                                                                                \
    X(vkCmdUpdateBuffer)                                                                                               \
    X(vkCmdWriteTimestamp)                                                                                             \
    X(vkCreateBuffer)                                                                                                  \
    X(vkCreateBufferView)                                                                                              \
    X(vkCreateCommandPool)                                                                                             \
    X(vkCreateComputePipelines)                                                                                        \
    X(vkCreateDescriptorPool)                                                                                          \
    X(vkCreateDescriptorSetLayout)                                                                                     \
    X(vkCreateDevice)                                                                                                  \
    X(vkCreateFence)                                                                                                   \
    X(vkCreateFramebuffer)                                                                                             \
    X(vkCreateGraphicsPipelines)                                                                                       \
    X(vkCreateImage)                                                                                                   \
    X(vkCreateImageView)                                                                                               \
    X(vkCreateInstance)                                                                                                \
    X(vkCreatePipelineCache)                                                                                           \
    X(vkCreatePipelineLayout)                                                                                          \
    X(vkCreateQueryPool)                                                                                               \
    X(vkCreateRenderPass)                                                                                              \
    X(vkCreateSampler)                                                                                                 \
    X(vkCreateSemaphore)                                                                                               \
    X(vkCreateShaderModule)                                                                                            \
    X(vkDestroyBuffer)                                                                                                 \
    X(vkDestroyBufferView)                                                                                             \
    X(vkDestroyCommandPool)                                                                                            \
    X(vkDestroyDescriptorPool)                                                                                         \
    X(vkDestroyDescriptorSetLayout)                                                                                    \
    X(vkDestroyDevice)                                                                                                 \
    X(vkDestroyFence)                                                                                                  \
    X(vkDestroyFramebuffer)                                                                                            \
    X(vkDestroyImage)                                                                                                  \
    X(vkDestroyImageView)                                                                                              \
    X(vkDestroyInstance)                                                                                               \
    X(vkDestroyPipeline)                                                                                               \
    X(vkDestroyPipelineCache)                                                                                          \
    X(vkDestroyPipelineLayout)                                                                                         \
    X(vkDestroyQueryPool)                                                                                              \
    X(vkDestroyRenderPass)                                                                                             \
    X(vkDestroySampler)                                                                                                \
    X(vkDestroySemaphore)                                                                                              \
    X(vkDestroyShaderModule)                                                                                           \
    X(vkDeviceWaitIdle)                                                                                                \
    X(vkEndCommandBuffer)                                                                                              \
    X(vkEnumerateDeviceExtensionProperties)                                                                            \
    X(vkEnumerateInstanceExtensionProperties)                                                                          \
    X(vkEnumerateInstanceLayerProperties)                                                                              \
    X(vkEnumerateInstanceVersion)                                                                                      \
    X(vkEnumeratePhysicalDevices)                                                                                      \
    X(vkFlushMappedMemoryRanges)                                                                                       \
    X(vkFreeCommandBuffers)                                                                                            \
    X(vkFreeMemory)                                                                                                    \
    X(vkGetBufferMemoryRequirements)                                                                                   \
    X(vkGetDeviceProcAddr)                                                                                             \
    X(vkGetDeviceQueue)                                                                                                \
    X(vkGetImageMemoryRequirements)                                                                                    \
    X(vkGetInstanceProcAddr)                                                                                           \
    X(vkGetPhysicalDeviceFeatures)                                                                                     \
    X(vkGetPhysicalDeviceFeatures2)                                                                                    \
    X(vkGetPhysicalDeviceFormatProperties)                                                                             \
    X(vkGetPhysicalDeviceMemoryProperties)                                                                             \
    X(vkGetPhysicalDeviceMemoryProperties2)                                                                            \
    X(vkGetPhysicalDeviceProperties)                                                                                   \
    X(vkGetPhysicalDeviceProperties2)                                                                                  \
    X(vkGetPhysicalDeviceQueueFamilyProperties)                                                                        \
    X(vkGetPipelineCacheData)                                                                                          \
    X(vkGetQueryPoolResults)                                                                                           \
    X(vkGetSemaphoreCounterValue)                                                                                      \
    X(vkInvalidateMappedMemoryRanges)                                                                                  \
    X(vkMapMemory)                                                                                                     \
    X(vkQueueSubmit)                                                                                                   \
    X(vkQueueWaitIdle)                                                                                                 \
    X(vkResetCommandBuffer)                                                                                            \
    X(vkResetFences)                                                                                                   \
    X(vkUpdateDescriptorSets)                                                                                          \
    X(vkWaitForFences)                                                                                                 \
    X(vkWaitSemaphores)

/// Functions that only a window needs; null before loadWindowFunctions.
#define POINTRT_VULKAN_WINDOW_FUNCTIONS(X)                                                                             \
    X(vkAcquireNextImageKHR)                                                                                           \
    X(vkCreateSwapchainKHR)                                                                                            \
    X(vkDestroySurfaceKHR)                                                                                             \
    X(vkDestroySwapchainKHR)                                                                                           \
    X(vkGetPhysicalDeviceSurfaceCapabilitiesKHR)                                                                       \
    X(vkGetPhysicalDeviceSurfaceFormatsKHR)                                                                            \
    X(vkGetPhysicalDeviceSurfacePresentModesKHR)                                                                       \
    X(vkGetSwapchainImagesKHR)                                                                                         \
    X(vkQueuePresentKHR)

#define POINTRT_DECLARE_VULKAN(name) extern PFN_##name name;
POINTRT_VULKAN_FUNCTIONS(POINTRT_DECLARE_VULKAN)
POINTRT_VULKAN_WINDOW_FUNCTIONS(POINTRT_DECLARE_VULKAN)
#undef POINTRT_DECLARE_VULKAN

/// Opens the loader; later calls do nothing. Throws Error kCannotRun if there is no loader or it is older than Vulkan
/// 1.1.
void loadVulkan();

/// Loads the functions of surfaces and swapchains. The instance must have the extensions of a window.
/// Throws Error kCannotRun if one is missing.
void loadWindowFunctions(VkInstance instance);

/// "VK_ERROR_DEVICE_LOST" for messages; an unknown value comes back as "VkResult -123".
std::string resultName(VkResult result);

/// Throws Error kCannotRun "cannot WHAT: VK_ERROR_..." unless result is VK_SUCCESS; DeviceLost for
/// VK_ERROR_DEVICE_LOST.
/// @param what a verb phrase
void check(VkResult result, const char* what);

} // namespace pointrt
