// SPDX-License-Identifier: Apache-2.0
// The pipelines that a driver has compiled, kept between runs in a file of the user's cache folder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"

namespace pointrt {

/// A driver's pipeline cache and its file, $XDG_CACHE_HOME/pointrt/pipelines/VENDOR-DEVICE.bin: one per model of
/// device, with what the driver in use has compiled. Without effect where the user has no cache folder.
class PipelineCache {
public:
    /// Opens the driver's cache with what the file holds. A file that is missing, damaged, or of another device or
    /// version of the driver counts as empty. CPU devices have none: Mesa's keeps programs in files of its own.
    void open(const Device& device);
    /// Keeps what the driver has compiled since open, and closes its cache. A file that cannot be written stays as it
    /// is. Of several processes, the last one's remains.
    void close(const Device& device);
    /// Null before open, and where there is none. Threads may compile with it at the same time.
    VkPipelineCache handle() const { return handle_; }

private:
    VkPipelineCache handle_ = VK_NULL_HANDLE;
    std::string path_;
    std::vector<std::uint8_t> kept_; ///< what the file holds of this driver
};

} // namespace pointrt
