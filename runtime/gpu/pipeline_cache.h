// SPDX-License-Identifier: Apache-2.0
// The pipelines that a driver has compiled, kept between runs in a file in the user's cache folder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"

namespace pointrt {

/// A driver's pipeline cache and its file, $XDG_CACHE_HOME/pointrt/pipelines/VENDOR-DEVICE.bin: one file per device
/// model, with the pipelines of the current driver. Does nothing if the user has no cache folder.
class PipelineCache {
public:
    /// Opens the driver's cache with the contents of the file. A file that is missing, damaged, or from another device
    /// or driver version counts as empty. CPU devices have no cache: Mesa caches programs itself.
    void open(const Device& device);
    /// Writes the pipelines that the driver has compiled since open to the file, and closes the cache. If the file
    /// cannot be written, it stays as it is. If several processes write it, the last one wins.
    void close(const Device& device);
    /// Null before open, and if there is no cache. Threads may compile with it at the same time.
    VkPipelineCache handle() const { return handle_; }

private:
    VkPipelineCache handle_ = VK_NULL_HANDLE;
    std::string path_;
    std::vector<std::uint8_t> kept_; ///< the bytes of the file for this driver
};

} // namespace pointrt
