// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/denoiser.h"

#include "runtime/util/on_error.h"
#include "shaders/denoise.spv.h"
#include "shaders/denoise_clean.spv.h"
#include "shaders/denoise_prepare.spv.h"
#include "shaders/denoise_variance.spv.h"

namespace pointrt {
namespace {

constexpr VkBufferUsageFlags kTexels = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr VkFormat kFourFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kTwoFloats = VK_FORMAT_R32G32_SFLOAT;
constexpr VkFormat kOneFloat = VK_FORMAT_R32_SFLOAT;
constexpr std::uint32_t kLevels = kDenoiseLevels, kLevelSteps = kDenoiseSteps - kLevels;
constexpr std::uint32_t kGroupWidth = 16, kGroupHeight = 8; // local_size of the shaders
/// Height of a picture at distance 1 with the default field of view of 40 degrees: 2 tan(20 degrees).
constexpr float kPictureAngle = 0.728f;

struct Push {
    std::int32_t size[4]; ///< width, height, pixels between taps
    float angles[4];      ///< angle of a pixel, radians
};
struct SizePush {
    std::int32_t size[4];
};

Buffer createTexels(Device& device, const char* what, std::uint64_t pixels, VkFormat format = kFourFloats) {
    const std::uint64_t floats = format == kOneFloat ? 1 : format == kTwoFloats ? 2 : 4;
    Buffer buffer = createBuffer(device, what, pixels * floats * sizeof(float), kTexels | kStorage);
    createTexelView(device, what, buffer, format);
    return buffer;
}

void createBuffers(Device& device, Denoiser& denoiser) {
    const std::uint64_t pixels = std::uint64_t{denoiser.width} * denoiser.height;
    denoiser.surface = createTexels(device, "denoiser's surfaces", pixels);
    denoiser.slope = createTexels(device, "denoiser's slopes", pixels, kTwoFloats);
    denoiser.factor = createTexels(device, "denoiser's albedo", pixels);
    for (Buffer& light : denoiser.light) light = createTexels(device, "denoiser's light", pixels);
    for (Buffer& guide : denoiser.guide_light) guide = createTexels(device, "denoiser's guide", pixels, kOneFloat);
    denoiser.result = createTexels(device, "denoised picture", pixels);
}

void createPrograms(Device& device, Denoiser& denoiser, bool has_variance) {
    denoiser.prepare =
        createProgram(device, "denoise_prepare", denoise_prepare_spv, {{SPEC_KNOWS_VARIANCE, has_variance}});
    denoiser.clean = createProgram(device, "denoise_clean", denoise_clean_spv);
    denoiser.variance =
        createProgram(device, "denoise_variance", denoise_variance_spv, {{SPEC_KNOWS_VARIANCE, has_variance}});
    denoiser.level = createProgram(device, "denoise", denoise_spv, {{SPEC_IS_LAST_LEVEL, 0}});
    denoiser.last_level = createProgram(device, "denoise", denoise_spv, {{SPEC_IS_LAST_LEVEL, 1}});
}

/// Descriptors of a level that reads light[from] and its guide, and writes light[to].
VkDescriptorSet createLevelSet(Device& device, const Denoiser& d, const Buffer& color, const Program& program,
                               std::size_t from, const Buffer& to) {
    return createDescriptorSet(device, d.pool, program,
                               {{BINDING_DENOISE_COLORS, &color},
                                {BINDING_DENOISE_LIGHT, &d.light[from]},
                                {BINDING_DENOISE_SURFACES, &d.surface},
                                {BINDING_DENOISE_SLOPES, &d.slope},
                                {BINDING_DENOISE_FACTORS, &d.factor},
                                {BINDING_DENOISE_GUIDE_LIGHT, &d.guide_light[from]},
                                {BINDING_DENOISE_LIGHT_OUT, &to},
                                {BINDING_DENOISE_GUIDE_LIGHT_OUT, &d.guide_light[1 - from]}});
}

void createSets(Device& device, Denoiser& d, const DenoiseInputs& inputs) {
    d.pool = createDescriptorPool(device, 6);
    const auto& light = d.light;
    d.prepare_set = createDescriptorSet(device, d.pool, d.prepare,
                                        {{BINDING_DENOISE_COLORS, inputs.color},
                                         {BINDING_DENOISE_GUIDES, inputs.surface},
                                         {BINDING_DENOISE_ALBEDOS, inputs.albedo},
                                         {BINDING_DENOISE_LIGHT_OUT, &light[1]},
                                         {BINDING_DENOISE_SURFACES_OUT, &d.surface},
                                         {BINDING_DENOISE_FACTORS_OUT, &d.factor}});
    d.clean_set = createDescriptorSet(device, d.pool, d.clean,
                                      {{BINDING_DENOISE_LIGHT, &light[1]},
                                       {BINDING_DENOISE_SURFACES, &d.surface},
                                       {BINDING_DENOISE_LIGHT_OUT, &light[0]},
                                       {BINDING_DENOISE_SLOPES_OUT, &d.slope},
                                       {BINDING_DENOISE_GUIDE_LIGHT_OUT, &d.guide_light[1]}});
    d.variance_set = createDescriptorSet(device, d.pool, d.variance,
                                         {{BINDING_DENOISE_LIGHT, &light[0]},
                                          {BINDING_DENOISE_SURFACES, &d.surface},
                                          {BINDING_DENOISE_SLOPES, &d.slope},
                                          {BINDING_DENOISE_LIGHT_OUT, &light[1]}});
    for (std::size_t i = 0; i < 2; ++i)
        d.level_sets[i] = createLevelSet(device, d, *inputs.color, d.level, i, light[1 - i]);
    d.last_set = createLevelSet(device, d, *inputs.color, d.last_level, kLevels % 2, d.result);
}

GroupCount groupsOf(const Denoiser& denoiser) {
    return {(denoiser.width + kGroupWidth - 1) / kGroupWidth, (denoiser.height + kGroupHeight - 1) / kGroupHeight, 1};
}

} // namespace

float denoisedPixelAngle(std::uint32_t height) { return kPictureAngle / static_cast<float>(height); }

Denoiser createDenoiser(Device& device, std::uint32_t width, std::uint32_t height, const DenoiseInputs& inputs) {
    Denoiser denoiser;
    denoiser.width = width;
    denoiser.height = height;
    denoiser.pixel_angle = denoisedPixelAngle(height);
    const OnError undo([&] { destroyDenoiser(device, denoiser); });
    createBuffers(device, denoiser);
    createPrograms(device, denoiser, inputs.has_variance);
    createSets(device, denoiser, inputs);
    return denoiser;
}

void destroyDenoiser(Device& device, Denoiser& denoiser) {
    destroyDescriptorPool(device, denoiser.pool);
    for (Program* program :
         {&denoiser.prepare, &denoiser.clean, &denoiser.variance, &denoiser.level, &denoiser.last_level})
        destroyProgram(device, *program);
    for (Buffer* buffer : {&denoiser.surface, &denoiser.slope, &denoiser.factor, &denoiser.light[0], &denoiser.light[1],
                           &denoiser.guide_light[0], &denoiser.guide_light[1], &denoiser.result})
        destroyBuffer(device, *buffer);
}

void recordDenoiseStep(VkCommandBuffer commands, const Denoiser& d, std::uint32_t step) {
    const auto width = static_cast<std::int32_t>(d.width), height = static_cast<std::int32_t>(d.height);
    const SizePush size{{width, height, 0, 0}};
    Push push{{width, height, 0, 0}, {d.pixel_angle, 0, 0, 0}};
    if (step == 0) recordDispatch(commands, d.prepare, d.prepare_set, pushBytes(size), groupsOf(d));
    if (step == 1) recordDispatch(commands, d.clean, d.clean_set, pushBytes(size), groupsOf(d));
    if (step == 2) recordDispatch(commands, d.variance, d.variance_set, pushBytes(push), groupsOf(d));
    if (step >= kLevelSteps) { // level i reads light[1] if i is even; the variance pass writes light[1]
        const std::uint32_t i = step - kLevelSteps;
        const bool last = i == kLevels - 1;
        push.size[2] = 1 << i;
        recordDispatch(commands, last ? d.last_level : d.level, last ? d.last_set : d.level_sets[(i + 1) % 2],
                       pushBytes(push), groupsOf(d));
    }
    recordBarrier(commands);
}

void recordDenoise(VkCommandBuffer commands, const Denoiser& denoiser) {
    for (std::uint32_t step = 0; step < kDenoiseSteps; ++step) recordDenoiseStep(commands, denoiser, step);
}

} // namespace pointrt
