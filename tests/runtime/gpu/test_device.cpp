// SPDX-License-Identifier: Apache-2.0
// Devices, buffers and programs on the available Vulkan device, with the validation layer: any message fails the test.
#include <gtest/gtest.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "format/base/error.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/device_choice.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "shaders/scale_words.spv.h"
#include "tests/support/says.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

constexpr VkBufferUsageFlags kTexelBuffer = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
constexpr VkBufferUsageFlags kStorageBuffer = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr std::size_t kPageWords = 1024;
// of scale_words.comp.glsl
constexpr gpu::Binding kWords{0}, kResult{3};
constexpr gpu::SpecId kFactor{0};

struct ScalePush {
    std::uint32_t count, summand, unused[2];
    float also_unused[3];
};

std::vector<std::uint32_t> countingWords(std::size_t count) {
    std::vector<std::uint32_t> words(count);
    std::iota(words.begin(), words.end(), 7u);
    return words;
}

class DeviceTest : public DeviceFixture {
protected:
    std::vector<std::uint32_t> download(const Buffer& buffer) {
        std::vector<std::uint32_t> words(buffer.bytes / 4);
        downloadBuffer(device, buffer, words.data(), buffer.bytes);
        return words;
    }

    /// Computes words[i] * 3 + 5 on the device. If indirect, reads the group count from a buffer.
    std::vector<std::uint32_t> scaleOnDevice(Buffer& words, bool indirect) {
        const std::uint32_t count = static_cast<std::uint32_t>(words.bytes / 4), groups = (count + 63) / 64;
        const std::vector<std::uint32_t> arguments = {0, groups, 1, 1};
        Buffer result = createBuffer(device, "result", words.bytes, kStorageBuffer);
        Buffer group_counts =
            createFilledBuffer(device, "arguments", arguments.data(), 16, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
        createTexelView(device, "words", words, VK_FORMAT_R32_UINT);
        Program program = createProgram(device, "scale_words", scale_words_spv, {{kFactor, 3}});
        VkDescriptorPool pool = createDescriptorPool(device, 1);
        const VkDescriptorSet set = createDescriptorSet(device, pool, program, {{kWords, &words}, {kResult, &result}});
        const ScalePush push{count, 5, {}, {}};
        const VkCommandBuffer commands = beginCommands(device);
        if (indirect)
            recordDispatchIndirect(commands, program, set, pushBytes(push), group_counts, 4);
        else
            recordDispatch(commands, program, set, pushBytes(push), {groups, 1, 1});
        submitAndWait(device, commands);
        std::vector<std::uint32_t> scaled = download(result);
        destroyDescriptorPool(device, pool);
        destroyProgram(device, program);
        destroyBuffer(device, group_counts);
        destroyBuffer(device, result);
        return scaled;
    }
};

std::vector<std::uint32_t> scaled(std::vector<std::uint32_t> words) {
    for (std::uint32_t& word : words) word = word * 3 + 5;
    return words;
}

TEST_F(DeviceTest, DescribesWhatItOpened) {
    EXPECT_FALSE(device.name.empty());
    EXPECT_GE(device.subgroup_size, 1u);
    EXPECT_GE(device.max_allocation_bytes, 1u << 30);
    EXPECT_GE(device.limits.maxTexelBufferElements, 1u << 24);
    EXPECT_NE(listDevices().find(device.name), std::string::npos);
}

TEST_F(DeviceTest, Workers_ShareTheMutexOfTheQueue) {
    ASSERT_NE(device.queue_mutex, nullptr);
    Device first, second;
    std::thread other([&] { first = workerDevice(device); });
    second = workerDevice(device);
    other.join();
    EXPECT_EQ(first.queue_mutex, device.queue_mutex);
    EXPECT_EQ(second.queue_mutex, device.queue_mutex);
    destroyWorkerDevice(first);
    destroyWorkerDevice(second);
}

TEST_F(DeviceTest, Names_AreOnWithValidation) {
    ASSERT_NE(std::getenv("POINTRT_VALIDATION"), nullptr);
    EXPECT_NE(device.setObjectName, nullptr);
    device.setObjectName = nullptr; // as without the extension
    Buffer buffer = createBuffer(device, "words", 64, kStorageBuffer);
    EXPECT_NE(buffer.handle, VkBuffer{});
    destroyBuffer(device, buffer);
}

TEST_F(DeviceTest, UploadsAndDownloads) {
    const std::vector<std::uint32_t> words = countingWords(100'003);
    Buffer buffer = createFilledBuffer(device, "words", words.data(), words.size() * 4, kStorageBuffer);
    EXPECT_EQ(download(buffer), words);
    const std::uint32_t patch[2] = {1, 2};
    uploadBuffer(device, buffer, patch, 8, 400);
    std::uint32_t read[3] = {};
    downloadBuffer(device, buffer, read, 12, 400);
    EXPECT_EQ(std::vector<std::uint32_t>(read, read + 3), (std::vector<std::uint32_t>{1, 2, words[102]}));
    EXPECT_THROW(uploadBuffer(device, buffer, patch, 8, buffer.bytes - 4), std::logic_error);
    destroyBuffer(device, buffer);
}

// Uploads as on devices with memory of their own, in more than one chunk.
TEST_F(DeviceTest, UnmappedMemory_IsStaged) {
    device.unified_memory = false;
    const std::vector<std::uint32_t> words = countingWords((80u << 20) / 4);
    Buffer buffer = createFilledBuffer(device, "words", words.data(), words.size() * 4, kStorageBuffer);
    EXPECT_EQ(buffer.mapped, nullptr);
    EXPECT_EQ(download(buffer), words);
    destroyBuffer(device, buffer);
}

TEST_F(DeviceTest, HasBuffersForEmptySections) {
    Buffer buffer = createFilledBuffer(device, "nothing", nullptr, 0, kTexelBuffer);
    createTexelView(device, "nothing", buffer, VK_FORMAT_R32G32B32A32_UINT);
    EXPECT_NE(buffer.view, nullptr);
    destroyBuffer(device, buffer);
}

TEST_F(DeviceTest, RefusesMoreThanTheDeviceAllocates) {
    try {
        createBuffer(device, "splats", device.max_allocation_bytes + 1, kStorageBuffer);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kCannotRun);
        EXPECT_NE(std::string(error.what()).find("splats"), std::string::npos) << error.what();
    }
}

TEST_F(DeviceTest, RunsAProgram) {
    const std::vector<std::uint32_t> words = countingWords(1000);
    Buffer buffer = createFilledBuffer(device, "words", words.data(), 4000, kTexelBuffer);
    EXPECT_EQ(scaleOnDevice(buffer, false), scaled(words));
    destroyBuffer(device, buffer);
}

TEST_F(DeviceTest, RunsAProgramIndirectly) {
    const std::vector<std::uint32_t> words = countingWords(1000);
    Buffer buffer = createFilledBuffer(device, "words", words.data(), 4000, kTexelBuffer);
    EXPECT_EQ(scaleOnDevice(buffer, true), scaled(words));
    destroyBuffer(device, buffer);
}

TEST_F(DeviceTest, ReadsAnImportedReadOnlyMappingInPlace) {
    if (!device.external_memory_host) GTEST_SKIP() << "this device has no VK_EXT_external_memory_host";
    const std::vector<std::uint32_t> words = countingWords(3 * kPageWords - 5);
    char path[] = "/tmp/pointrt_import_XXXXXX";
    const int file = mkstemp(path);
    ASSERT_GE(file, 0);
    unlink(path);
    ASSERT_EQ(write(file, words.data(), words.size() * 4), static_cast<ssize_t>(words.size() * 4));
    void* mapped = mmap(nullptr, words.size() * 4, PROT_READ, MAP_PRIVATE, file, 0);
    ASSERT_NE(mapped, MAP_FAILED);
    Buffer buffer = importHostBuffer(device, mapped, words.size() * 4, kTexelBuffer);
    if (buffer.handle) {
        EXPECT_TRUE(buffer.imported);
        EXPECT_EQ(scaleOnDevice(buffer, false), scaled(words));
        EXPECT_EQ(download(buffer), words);
    } else {
        EXPECT_FALSE(device.unified_memory) << "a device in host memory refused the import";
    }
    destroyBuffer(device, buffer);
    munmap(mapped, words.size() * 4);
    close(file);
}

TEST_F(DeviceTest, DoesNotImportFromTheMiddleOfAPage) {
    std::vector<std::uint32_t> words(4 * kPageWords);
    const auto address = reinterpret_cast<std::uintptr_t>(words.data());
    const Buffer buffer = importHostBuffer(device, words.data() + (address % 4096 == 4 ? 2 : 1), 4096, kTexelBuffer);
    EXPECT_EQ(buffer.handle, nullptr);
}

TEST_F(DeviceTest, ChecksBindingsAndPushConstantsAgainstTheShader) {
    Buffer buffer = createBuffer(device, "words", 64, kTexelBuffer | kStorageBuffer);
    Program program = createProgram(device, "scale_words", scale_words_spv, {{kFactor, 3}});
    EXPECT_EQ(program.shader.push_bytes, sizeof(ScalePush));
    ASSERT_EQ(program.shader.bindings.size(), 2u);
    EXPECT_EQ(program.shader.bindings[0].type, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    EXPECT_EQ(program.shader.bindings[1].type, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    EXPECT_EQ(program.shader.bindings[1].slot, kResult);
    EXPECT_EQ(program.shader.constants, std::vector{kFactor});
    EXPECT_THROW(createProgram(device, "scale_words", scale_words_spv), std::logic_error);
    EXPECT_THROW(createProgram(device, "scale_words", scale_words_spv, {{gpu::SpecId{1}, 3}}), std::logic_error);
    VkDescriptorPool pool = createDescriptorPool(device, 4);
    EXPECT_THROW(createDescriptorSet(device, pool, program, {{kWords, &buffer}}), std::logic_error);
    EXPECT_THROW(createDescriptorSet(device, pool, program, {{kWords, &buffer}, {kResult, &buffer}}), std::logic_error)
        << "binding 0 has no view";
    createTexelView(device, "words", buffer, VK_FORMAT_R32_UINT);
    EXPECT_THROW(createDescriptorSet(device, pool, program, {{kWords, &buffer}, {gpu::Binding{2}, &buffer}}),
                 std::logic_error);
    const VkDescriptorSet set = createDescriptorSet(device, pool, program, {{kWords, &buffer}, {kResult, &buffer}});
    EXPECT_THROW(recordDispatch(VK_NULL_HANDLE, program, set, {}, {}), std::logic_error);
    destroyDescriptorPool(device, pool);
    destroyProgram(device, program);
    destroyBuffer(device, buffer);
}

TEST_F(DeviceTest, Selector_IsAnIndexOrPartOfTheName) {
    for (const std::string& selector : {std::string("0"), device.name.substr(1, 4)}) {
        Device other = createDevice({selector, false});
        EXPECT_FALSE(other.name.empty());
        destroyDevice(other);
    }
    try {
        createDevice({"no such device", false});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kCannotRun);
        EXPECT_NE(std::string(error.what()).find(device.name), std::string::npos) << error.what();
    }
}

TEST(Validation, CountsAMessage) {
    setenv("POINTRT_VALIDATION", "1", 1);
    Device device = createDevice({});
    const std::uint64_t before = validationMessages();
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.usage = kStorageBuffer;
    VkBuffer buffer = VK_NULL_HANDLE;
    testing::internal::CaptureStderr();
    vkCreateBuffer(device.handle, &info, nullptr, &buffer); // a size of 0 is not allowed
    EXPECT_NE(testing::internal::GetCapturedStderr().find("Vulkan validation: "), std::string::npos);
    EXPECT_GT(validationMessages(), before);
    vkDestroyBuffer(device.handle, buffer, nullptr);
    destroyDevice(device);
}

// Buffers share allocations, even if they are created and destroyed in any order; large ones have their own.
TEST_F(DeviceTest, Buffers_ShareAllocations) {
    const std::size_t before = device.memory_pool->size();
    std::vector<Buffer> buffers;
    const auto make = [&](std::uint64_t bytes) {
        buffers.push_back(createBuffer(device, "words", bytes, kStorageBuffer));
    };
    for (int i = 0; i < 100; ++i) make(1000);
    EXPECT_EQ(device.memory_pool->size(), before + 1);
    const auto word = [&](const Buffer& buffer) { return static_cast<std::uint32_t*>(buffer.mapped); };
    if (buffers[0].mapped) {
        for (std::uint32_t i = 0; i < 100; ++i) std::fill_n(word(buffers[i]), 250, i);
        for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(std::count(word(buffers[i]), word(buffers[i]) + 250, i), 250);
    }
    make(20u << 20);
    EXPECT_EQ(device.memory_pool->size(), before + 2);
    for (Buffer& buffer : buffers) destroyBuffer(device, buffer);
    EXPECT_LE(device.memory_pool->size(), before + 1) << "one shared allocation stays for the next buffers";
    buffers.clear();
    make(1000);
    EXPECT_LE(device.memory_pool->size(), before + 1);
    destroyBuffer(device, buffers[0]);
}

// Uploads do not wait: the data may change and the buffer may be destroyed at once.
TEST_F(DeviceTest, Uploads_KeepTheirOrder) {
    device.unified_memory = false;
    Buffer buffer = createBuffer(device, "words", 40u << 20, kStorageBuffer);
    std::vector<std::uint32_t> words(buffer.bytes / 4);
    for (const std::uint32_t value : {1u, 2u, 3u}) {
        std::fill(words.begin(), words.end(), value);
        uploadBuffer(device, buffer, words.data(), buffer.bytes);
        uploadBuffer(device, buffer, &value, 4, 4 * value);
    }
    words.assign(words.size(), 0);
    EXPECT_EQ(download(buffer), std::vector<std::uint32_t>(words.size(), 3));
    uploadBuffer(device, buffer, words.data(), buffer.bytes);
    destroyBuffer(device, buffer);
}

TEST_F(DeviceTest, Submissions_AreNumbered) {
    EXPECT_TRUE(isDone(device, 0));
    const std::uint64_t first = submit(device, beginCommands(device)), second = submit(device, beginCommands(device));
    EXPECT_EQ(second, first + 1);
    waitFor(device, second);
    EXPECT_TRUE(isDone(device, first));
    EXPECT_FALSE(isDone(device, second + 1));
}

/// A usable candidate.
Candidate goodCandidate(const char* name, VkPhysicalDeviceType type) {
    Candidate candidate;
    std::snprintf(candidate.properties.deviceName, sizeof candidate.properties.deviceName, "%s", name);
    candidate.properties.apiVersion = VK_API_VERSION_1_3;
    candidate.properties.deviceType = type;
    candidate.properties.limits.maxTexelBufferElements = 1u << 27;
    candidate.properties.limits.maxPerStageDescriptorStorageImages = 8;
    candidate.properties.limits.maxPerStageDescriptorSampledImages = 128;
    candidate.properties.limits.maxPerStageDescriptorStorageBuffers = 32;
    candidate.properties.limits.maxPerStageDescriptorUniformBuffers = 15;
    candidate.subgroup.supportedStages = VK_SHADER_STAGE_COMPUTE_BIT;
    candidate.subgroup.supportedOperations = ~0u;
    candidate.queue_family = 0;
    candidate.reads_texels = true;
    return candidate;
}

/// In a process that has not enumerated devices yet; without a driver all threads get the error.
TEST(Devices, AreFound_ByConcurrentFirstCallers) {
    std::vector<std::string> answers(4);
    {
        std::vector<std::jthread> threads;
        for (std::string& answer : answers)
            threads.emplace_back([&answer] {
                try {
                    answer = listDevices();
                } catch (const Error& error) {
                    answer = error.what();
                }
            });
    }
    EXPECT_FALSE(answers[0].empty());
    for (const std::string& answer : answers) EXPECT_EQ(answer, answers[0]);
}

TEST(DeviceChoice, RefusesWithReasons) {
    const Candidate good = goodCandidate("GPU", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU);
    EXPECT_EQ(refusalOf(good), "");
    Candidate old = good, queueless = good, small = good, scalar = good, graphics = good, blind = good;
    old.properties.apiVersion = VK_API_VERSION_1_1;
    EXPECT_NE(refusalOf(old).find("Vulkan 1.1"), std::string::npos);
    queueless.queue_family.reset();
    EXPECT_NE(refusalOf(queueless).find("queue"), std::string::npos);
    small.properties.limits.maxTexelBufferElements = 65536;
    EXPECT_NE(refusalOf(small).find("65536"), std::string::npos);
    scalar.subgroup.supportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
    EXPECT_NE(refusalOf(scalar).find("ballot"), std::string::npos);
    graphics.subgroup.supportedStages = VK_SHADER_STAGE_FRAGMENT_BIT;
    EXPECT_NE(refusalOf(graphics).find("compute shaders"), std::string::npos);
    blind.reads_texels = false;
    EXPECT_NE(refusalOf(blind).find("texel"), std::string::npos);
}

// The sizes that drivers report: by default, the least and the largest on request.
TEST(DeviceChoice, AsksForSubgroupsOf32_WhereDriversTakeMore) {
    const struct {
        const char* device;
        std::uint32_t usual, least, largest, asked;
    } drivers[] = {{"RDNA 2 and 3, RADV", 64, 32, 64, 32},
                   {"GCN 5, RADV", 64, 64, 64, 0},
                   {"Intel, anv", 32, 8, 32, 0},
                   {"NVIDIA", 32, 32, 32, 0},
                   {"Adreno, turnip", 128, 64, 128, 0},
                   {"lavapipe", 8, 8, 8, 0},
                   {"a driver without a choice", 64, 0, 0, 0}};
    for (const auto& each : drivers) {
        Candidate candidate = goodCandidate(each.device, VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU);
        candidate.subgroup.subgroupSize = each.usual;
        candidate.least_subgroup = each.least;
        candidate.largest_subgroup = each.largest;
        EXPECT_EQ(subgroupSizeFor(candidate), each.asked) << each.device;
    }
}

TEST(DeviceChoice, QueriesRaysOnRequest_AndByItselfOnGpus) {
    Candidate gpu = goodCandidate("GPU", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU);
    EXPECT_FALSE(queriesRays(gpu, Traversal::kAuto));
    EXPECT_FALSE(queriesRays(gpu, Traversal::kWalk));
    try {
        queriesRays(gpu, Traversal::kHardware);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kCannotRun);
        EXPECT_SAYS(error.what(), "*GPU has no ray queries*");
    }
    Candidate cpu = goodCandidate("CPU", VK_PHYSICAL_DEVICE_TYPE_CPU);
    gpu.ray_queries = cpu.ray_queries = true;
    EXPECT_FALSE(queriesRays(gpu, Traversal::kWalk));
    EXPECT_TRUE(queriesRays(gpu, Traversal::kAuto));
    EXPECT_FALSE(queriesRays(cpu, Traversal::kAuto)) << "it would emulate them";
    EXPECT_TRUE(queriesRays(cpu, Traversal::kHardware));
}

// Limits of real drivers: V3D of a Raspberry Pi has 4 storage texel and 8 storage buffers.
TEST(DeviceChoice, RefusesTooFewDescriptorsOfAnyKind) {
    const Candidate good = goodCandidate("GPU", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU);
    const auto refusalWith = [&](std::uint32_t VkPhysicalDeviceLimits::*limit, std::uint32_t value) {
        Candidate candidate = good;
        candidate.properties.limits.*limit = value;
        return refusalOf(candidate);
    };
    EXPECT_SAYS(refusalWith(&VkPhysicalDeviceLimits::maxPerStageDescriptorStorageImages, 4), "*4 storage texel*");
    EXPECT_SAYS(refusalWith(&VkPhysicalDeviceLimits::maxPerStageDescriptorSampledImages, 16), "*16 uniform texel*");
    EXPECT_SAYS(refusalWith(&VkPhysicalDeviceLimits::maxPerStageDescriptorStorageBuffers, 8), "*8 storage buffers*");
    EXPECT_SAYS(refusalWith(&VkPhysicalDeviceLimits::maxPerStageDescriptorUniformBuffers, 1), "*1 uniform buffers*");
}

TEST(DeviceChoice, PrefersTheFastestKind) {
    std::vector<Candidate> candidates = {goodCandidate("llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU),
                                         goodCandidate("Iris", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
                                         goodCandidate("Virtio", VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU),
                                         goodCandidate("GeForce", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU)};
    EXPECT_EQ(&chooseCandidate(candidates, ""), &candidates[3]);
    EXPECT_EQ(&chooseCandidate(candidates, "2"), &candidates[2]);
    EXPECT_EQ(&chooseCandidate(candidates, "LLVM"), &candidates[0]);
    candidates[3].refusal = "no compute queue";
    EXPECT_EQ(&chooseCandidate(candidates, ""), &candidates[1]);
    try {
        chooseCandidate(candidates, "force");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_SAYS(error.what(), "*0 \"llvmpipe\": *\"force\"*1 \"Iris\": *\"force\"*2 \"Virtio\": "
                                  "*\"force\"*3 \"GeForce\": no compute queue");
    }
    EXPECT_THROW(chooseCandidate({}, ""), Error);
}

} // namespace
} // namespace pointrt
