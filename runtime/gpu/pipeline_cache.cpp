// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/pipeline_cache.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "format/base/error.h"
#include "format/os/atomic_file.h"
#include "format/os/user_folder.h"
#include "runtime/util/input_file.h"

namespace pointrt {
namespace {

/// Twenty programs for each of ten kinds of scenes, with up to 200 KB per program for its code and the driver's data.
constexpr std::uint64_t kMostBytes = 40ull << 20;
constexpr std::array<char, 8> kPipelineFileMagic = {'P', 'R', 'T', 'P', 'I', 'P', 'E', '1'};

/// Header of the file. Drivers do not check what they are given, so the hash detects damaged files first.
struct FileHeader {
    std::array<char, 8> magic = kPipelineFileMagic;
    std::uint32_t vendor = 0, device = 0, driver = 0; ///< driver: its version number
    std::uint32_t unused = 0;
    std::array<std::uint8_t, VK_UUID_SIZE> uuid{}; ///< changes with the format of the driver's cache
    std::uint64_t bytes = 0, hash = 0;             ///< size and XXH3 hash of the bytes that follow
    bool operator==(const FileHeader&) const = default;
};
static_assert(sizeof(FileHeader) == 56, "no padding, which would be written");

FileHeader headerFor(const VkPhysicalDeviceProperties& properties, const std::vector<std::uint8_t>& data) {
    FileHeader header;
    header.vendor = properties.vendorID;
    header.device = properties.deviceID;
    header.driver = properties.driverVersion;
    std::memcpy(header.uuid.data(), properties.pipelineCacheUUID, VK_UUID_SIZE);
    header.bytes = data.size();
    header.hash = XXH3_64bits(data.data(), data.size());
    return header;
}

std::string fileFor(const VkPhysicalDeviceProperties& properties) {
    const std::string folder = userCacheFolder();
    if (folder.empty()) return {};
    char name[40]; // two numbers of eight digits and 16 characters around them
    std::snprintf(name, sizeof name, "/pipelines/%08x-%08x.bin", properties.vendorID, properties.deviceID);
    return folder + name;
}

/// The pipeline cache in the file at path; empty if the file is missing, damaged, or from another device or driver.
std::vector<std::uint8_t> readKept(const std::string& path, const VkPhysicalDeviceProperties& properties) {
    std::vector<std::uint8_t> bytes;
    try {
        bytes = readFileStart(path, sizeof(FileHeader) + kMostBytes);
    } catch (const Error&) { // there is no file yet, or it cannot be read
        return {};
    }
    FileHeader header;
    if (bytes.size() < sizeof header) return {};
    std::memcpy(&header, bytes.data(), sizeof header);
    bytes.erase(bytes.begin(), bytes.begin() + sizeof header);
    return header == headerFor(properties, bytes) ? bytes : std::vector<std::uint8_t>();
}

/// The driver's cache as bytes; empty if it has no pipelines.
std::vector<std::uint8_t> cacheData(const Device& device, VkPipelineCache cache) {
    std::size_t bytes = 0;
    if (vkGetPipelineCacheData(device.handle, cache, &bytes, nullptr) != VK_SUCCESS) return {};
    std::vector<std::uint8_t> data(bytes);
    if (vkGetPipelineCacheData(device.handle, cache, &bytes, data.data()) != VK_SUCCESS) return {};
    data.resize(bytes);
    return bytes > sizeof(VkPipelineCacheHeaderVersionOne) ? data : std::vector<std::uint8_t>();
}

void writeKept(const std::string& path, const FileHeader& header, const std::vector<std::uint8_t>& data) {
    if (!makePrivateFolder(std::filesystem::path(path).parent_path().string())) return;
    format::AtomicFile file;
    if (file.open(path) && file.write(&header, sizeof header) && file.write(data.data(), data.size())) file.commit();
}

VkPhysicalDeviceProperties propertiesOf(const Device& device) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device.physical, &properties);
    return properties;
}

} // namespace

void PipelineCache::open(const Device& device) {
    if (device.type == VK_PHYSICAL_DEVICE_TYPE_CPU) return;
    const VkPhysicalDeviceProperties properties = propertiesOf(device);
    path_ = fileFor(properties);
    if (path_.empty()) return;
    kept_ = readKept(path_, properties);
    VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = kept_.size();
    info.pInitialData = kept_.data();
    check(vkCreatePipelineCache(device.handle, &info, nullptr, &handle_), "create a pipeline cache");
}

void PipelineCache::close(const Device& device) {
    if (!handle_) return;
    const std::vector<std::uint8_t> data = cacheData(device, handle_);
    std::error_code ignored;
    if (data.size() > kMostBytes) // start over, so that the pipelines in use now are kept
        std::filesystem::remove(path_, ignored);
    else if (!data.empty() && data != kept_)
        writeKept(path_, headerFor(propertiesOf(device), data), data);
    vkDestroyPipelineCache(device.handle, handle_, nullptr);
    handle_ = VK_NULL_HANDLE;
}

} // namespace pointrt
