// SPDX-License-Identifier: Apache-2.0
// Registers that AMD's compiler in Mesa gives the programs that walk through scans. RADV_FORCE_FAMILY makes it compile
// for a GPU that is not there. Skipped without that driver.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "runtime/gpu/program.h"
#include "runtime/gpu/spirv.h"
#include "runtime/gpu/vulkan.h"
#include "runtime/scene/integrator.h"
#include "shaders/beam.spv.h"
#include "shaders/beam_pooled.spv.h"
#include "shaders/intersect_camera.spv.h"
#include "shaders/intersect_camera_pooled.spv.h"
#include "shaders/intersect_closest.spv.h"
#include "shaders/intersect_closest_pooled.spv.h"
#include "shaders/intersect_shadow.spv.h"
#include "shaders/intersect_shadow_pooled.spv.h"
#include "shaders/intersect_shadow_ray.spv.h"
#include "shaders/intersect_shadow_ray_pooled.spv.h"
#include "shaders/shared/params.h"
#include "tests/gpu/offline/pretended.h"

namespace pointrt::test {
namespace {

using gpu::uint; // the masks of FEATURE_* cast to it

/// With at most this many of its 1,024 registers in use, a SIMD of Navi 21 runs 16 subgroups of 32 lanes, the maximum.
constexpr std::uint64_t kMostRegisters = 64;
constexpr std::uint32_t kLanes = 32;

/// The manifest of AMD's driver, or nullopt.
std::string driverOfAmd() {
    const std::filesystem::path folder = "/usr/share/vulkan/icd.d";
    std::error_code none;
    for (const auto& file : std::filesystem::directory_iterator(folder, none))
        if (file.path().filename().string().starts_with("radeon_icd")) return file.path();
    return {};
}

/// A device of AMD's driver that can only compile.
class Compiler {
public:
    Compiler() {
        loadVulkan();
        VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
        application.apiVersion = VK_API_VERSION_1_2;
        VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
        info.pApplicationInfo = &application;
        check(vkCreateInstance(&info, nullptr, &instance_), "create an instance");
        std::uint32_t count = 1;
        VkPhysicalDevice physical = VK_NULL_HANDLE;
        vkEnumeratePhysicalDevices(instance_, &count, &physical);
        if (!physical) return;
        createDevice(physical);
        statistics_ = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
            vkGetDeviceProcAddr(device_, "vkGetPipelineExecutableStatisticsKHR"));
    }
    ~Compiler() {
        if (device_) vkDestroyDevice(device_, nullptr);
        vkDestroyInstance(instance_, nullptr);
    }
    Compiler(const Compiler&) = delete;
    Compiler& operator=(const Compiler&) = delete;

    bool isThere() const { return device_ != VK_NULL_HANDLE; }

    std::map<std::string, std::uint64_t> compile(std::span<const std::uint32_t> spirv,
                                                 std::span<const SpecConstant> constants) {
        Built built;
        createLayout(reflectShader(spirv), built);
        VkShaderModuleCreateInfo module{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
        module.codeSize = spirv.size_bytes();
        module.pCode = spirv.data();
        check(vkCreateShaderModule(device_, &module, nullptr, &built.module), "create a module");
        createPipeline(constants, built);
        const auto values = statisticsOf(built.pipeline);
        destroy(built);
        return values;
    }

private:
    struct Built {
        std::vector<VkDescriptorSetLayout> sets;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        VkShaderModule module = VK_NULL_HANDLE;
        VkPipeline pipeline = VK_NULL_HANDLE;
    };

    void createDevice(VkPhysicalDevice physical) {
        const float priority = 1;
        VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        VkPhysicalDeviceSubgroupSizeControlFeatures lanes{
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES};
        lanes.subgroupSizeControl = VK_TRUE;
        VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics{
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR, &lanes};
        statistics.pipelineExecutableInfo = VK_TRUE;
        const std::array extensions{VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME,
                                    VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME};
        VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &statistics};
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue;
        info.enabledExtensionCount = extensions.size();
        info.ppEnabledExtensionNames = extensions.data();
        check(vkCreateDevice(physical, &info, nullptr, &device_), "create a device");
    }

    void createLayout(const ShaderInterface& shader, Built& built) {
        built.sets.resize(shader.bindings.back().set + 1);
        for (std::uint32_t set = 0; set < built.sets.size(); ++set) {
            std::vector<VkDescriptorSetLayoutBinding> bindings;
            for (const ShaderBinding& each : shader.bindings)
                if (each.set == set)
                    bindings.push_back({static_cast<std::uint32_t>(each.slot), each.type, each.count,
                                        VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
            VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
            info.bindingCount = static_cast<std::uint32_t>(bindings.size());
            info.pBindings = bindings.data();
            check(vkCreateDescriptorSetLayout(device_, &info, nullptr, &built.sets[set]), "create a set layout");
        }
        const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, shader.push_bytes};
        VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
        info.setLayoutCount = static_cast<std::uint32_t>(built.sets.size());
        info.pSetLayouts = built.sets.data();
        info.pushConstantRangeCount = push.size ? 1 : 0;
        info.pPushConstantRanges = &push;
        check(vkCreatePipelineLayout(device_, &info, nullptr, &built.layout), "create a layout");
    }

    void createPipeline(std::span<const SpecConstant> constants, Built& built) {
        std::vector<VkSpecializationMapEntry> entries;
        for (std::size_t i = 0; i < constants.size(); ++i)
            entries.push_back({static_cast<std::uint32_t>(constants[i].id),
                               static_cast<std::uint32_t>(i * sizeof(SpecConstant) + offsetof(SpecConstant, value)),
                               4});
        const VkSpecializationInfo values{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                          constants.size_bytes(), constants.data()};
        VkPipelineShaderStageRequiredSubgroupSizeCreateInfo lanes{
            VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO};
        lanes.requiredSubgroupSize = kLanes;
        VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
        info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
        info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                      &lanes,
                      0,
                      VK_SHADER_STAGE_COMPUTE_BIT,
                      built.module,
                      "main",
                      &values};
        info.layout = built.layout;
        check(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &built.pipeline), "compile");
    }

    std::map<std::string, std::uint64_t> statisticsOf(VkPipeline pipeline) const {
        VkPipelineExecutableInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR};
        info.pipeline = pipeline;
        std::uint32_t count = 0;
        statistics_(device_, &info, &count, nullptr);
        std::vector<VkPipelineExecutableStatisticKHR> listed(count,
                                                             {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
        statistics_(device_, &info, &count, listed.data());
        std::map<std::string, std::uint64_t> values;
        for (const VkPipelineExecutableStatisticKHR& each : listed) values[each.name] = each.value.u64;
        return values;
    }

    void destroy(const Built& built) {
        vkDestroyPipeline(device_, built.pipeline, nullptr);
        vkDestroyShaderModule(device_, built.module, nullptr);
        vkDestroyPipelineLayout(device_, built.layout, nullptr);
        for (VkDescriptorSetLayout set : built.sets) vkDestroyDescriptorSetLayout(device_, set, nullptr);
    }

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    PFN_vkGetPipelineExecutableStatisticsKHR statistics_ = nullptr;
};

/// The properties in which scans differ.
struct Scan {
    const char* name;
    bool uneven, balls, clipped;
};

/// As for a matte room with lamps on a GPU (see runtime/render/programs.cpp).
std::vector<SpecConstant> constantsFor(const Scan& scan, Integrator integrator, bool pooled) {
    return {{SPEC_UNEVEN, scan.uneven},
            {SPEC_ORIENTED, 1},
            {SPEC_SKY_IMAGE, 0},
            {SPEC_INTEGRATOR, static_cast<std::uint32_t>(integrator)},
            {SPEC_FEATURES, FEATURE_LIGHT(LIGHT_POINT) | FEATURE_MATERIAL(MATERIAL_MATTE) | FEATURE_SHAPE(SHAPE_BOX) |
                                FEATURE_SECONDARY_RAYS | FEATURE_INLINE_NEE | (scan.clipped ? FEATURE_CLIPS : 0u)},
            {SPEC_CAMERA_PASS, 0},
            {SPEC_NOISY, 0},
            {SPEC_GATHERS_PHOTONS, 0},
            {SPEC_SHAPE_KINDS, 0},
            {SPEC_CLIPS_TO_CORE, pooled},
            {SPEC_CULL_BOXES, CULL_INSTANCES},
            {SPEC_HAS_BALLS, scan.balls},
            {SPEC_ONE_BOUNCE, 1},
            {SPEC_CLIPPED, scan.clipped},
            {SPEC_PANORAMA_EYES, 0},
            {SPEC_READS_STORAGE, 1}};
}

struct WalkProgram {
    const char* name;
    std::span<const std::uint32_t> spirv, pooled;
    Integrator integrator = Integrator::kPath;
};

const WalkProgram kWalks[] = {
    {"beam", beam_spv, beam_pooled_spv},
    {"intersect_camera", intersect_camera_spv, intersect_camera_pooled_spv},
    {"intersect_closest", intersect_closest_spv, intersect_closest_pooled_spv},
    {"intersect_shadow", intersect_shadow_spv, intersect_shadow_pooled_spv, Integrator::kPhong},
    {"intersect_shadow_ray", intersect_shadow_ray_spv, intersect_shadow_ray_pooled_spv},
};

TEST(Registers, OfWalksLetASimdHoldAllSubgroupsThatItCan) {
    const std::string driver = driverOfAmd();
    if (driver.empty()) GTEST_SKIP() << "Mesa's driver for AMD is not installed";
    const Environment environment(
        {{"VK_ICD_FILENAMES", driver}, {"RADV_FORCE_FAMILY", "navi21"}, {"MESA_SHADER_CACHE_DISABLE", "true"}});
    Compiler compiler;
    if (!compiler.isThere()) GTEST_SKIP() << "Mesa's driver for AMD compiles only where a GPU is";
    const Scan even{"even", false, false, false}, uneven{"uneven", true, false, false},
        clipped{"clipped", false, false, true};
    const auto measure = [&](const WalkProgram& walk, const Scan& scan, bool pooled) {
        SCOPED_TRACE(std::string(walk.name) + (pooled ? ", pooled, " : ", ") + scan.name);
        auto statistics =
            compiler.compile(pooled ? walk.pooled : walk.spirv, constantsFor(scan, walk.integrator, pooled));
        ASSERT_TRUE(statistics.contains("VGPRs"));
        EXPECT_LE(statistics["VGPRs"], kMostRegisters);
        EXPECT_EQ(statistics["Spilled VGPRs"], 0u);
        EXPECT_EQ(statistics["Spilled SGPRs"], 0u);
        EXPECT_EQ(statistics["Scratch size"], 0u);
    };
    for (const WalkProgram& walk : kWalks) {
        measure(walk, even, false);
        for (const Scan& scan : {even, uneven, clipped}) measure(walk, scan, true);
    }
}

} // namespace
} // namespace pointrt::test
