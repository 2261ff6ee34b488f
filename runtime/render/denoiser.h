// SPDX-License-Identifier: Apache-2.0
// The preview denoiser: an edge-avoiding filter guided by normal, depth, albedo and variance. It is biased: do not use
// it for pictures to be measured. This filters buffers on the device; picture_filter.h filters films on the host.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// Device buffers of a picture, 4 floats per pixel, rows from the top, each with a VK_FORMAT_R32G32B32A32_SFLOAT view.
struct DenoiseInputs {
    const Buffer* color = nullptr; ///< linear rgb, alpha; pixels of alpha 0 are not filtered
    /// Normal (0: unknown) and depth along the ray (0, negative or not finite: unknown).
    const Buffer* surface = nullptr;
    const Buffer* albedo = nullptr; ///< linear albedo (1: unknown) and the variance of the mean luminance of rgb
    bool has_variance = true; ///< false: ignores the fourth float of albedo and estimates variance from the picture
};

/// Programs and buffers to filter pictures of one size repeatedly. Free it with destroyDenoiser.
struct Denoiser {
    std::uint32_t width = 0,
                  height = 0; ///< pixels; may be reduced as long as the product does not exceed the one at creation
    float pixel_angle = 0;    ///< radians
    Program prepare, clean, variance, level, last_level;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet prepare_set{}, clean_set{}, variance_set{}, last_set{};
    std::array<VkDescriptorSet, 2> level_sets{}; ///< [i] reads light[i] and writes light[1 - i]
    Buffer surface, slope, factor;               ///< see denoise_surface.glsl; factor: albedo divided out
    std::array<Buffer, 2> light;                 ///< rgb divided by albedo, and variance of its luminance
    std::array<Buffer, 2> guide_light;           ///< luminance without specks: denoise_clean.comp.glsl
    Buffer result;                               ///< 4 floats per pixel: filtered linear rgb, alpha of the input
};

/// Per pixel: four floats in each of four buffers and the result, two in the slopes, one in each of two guides.
constexpr std::uint64_t kDenoiserBytes = (5 * 4 + 2 + 2) * sizeof(float);

/// For pictures of width x height pixels (at least 1) in the buffers of inputs, which must outlive the denoiser.
/// Takes kDenoiserBytes of device memory per pixel. Throws Error kCannotRun if the device lacks memory.
Denoiser createDenoiser(Device& device, std::uint32_t width, std::uint32_t height, const DenoiseInputs& inputs);
void destroyDenoiser(Device& device, Denoiser& denoiser);

/// Records the whole filter: inputs to denoiser.result. Ends with a barrier (recordBarrier); the caller must record
/// one after writing the inputs.
///
/// Method: divides by the albedo; clamps fireflies, pixels over 6 times as bright as their second brightest neighbour
/// with a standard deviation of more than a quarter of their brightness, to that neighbour's brightness, which loses
/// energy; then applies 5 levels of an a-trous wavelet with taps 1, 2, 4, 8 and 16 pixels apart, weighted by normal,
/// distance from the plane of the surface, and luminance relative to its variance, after the luminance has been moved
/// towards the median around the pixel as far as noise explains the difference; and multiplies by the albedo. On
/// outlines between surfaces whose albedos differ, the result stays within the colours around the pixel. Pixels of
/// variance 0 are unchanged.
/// Preserves the mean of symmetric noise; exponential noise at 4 samples loses 1.5%. Pixels of alpha 0 are copied;
/// partly covered ones are averaged only with those in the same eighth of alpha. Pixels that are not finite take the
/// mean of their 8 neighbours; light is clamped to 1e9 times the albedo. Dammertz et al., Edge-Avoiding A-Trous Wavelet
/// Transform for fast Global Illumination Filtering, HPG 2010; Schied et al., Spatiotemporal Variance-Guided Filtering,
/// HPG 2017, without its temporal half.
void recordDenoise(VkCommandBuffer commands, const Denoiser& denoiser);

/// The same filter in kDenoiseSteps steps, numbered from 0, that take about equally long.
constexpr std::uint32_t kDenoiseLevels = 5, kDenoiseSteps = 3 + kDenoiseLevels;
void recordDenoiseStep(VkCommandBuffer commands, const Denoiser& denoiser, std::uint32_t step);

/// Radius in pixels of the neighbourhood that a result depends on: 1 for firefly clamping, 3 for the variance estimate
/// (denoise_variance.comp.glsl), and the taps of the levels.
constexpr std::uint32_t kDenoiseReach = 1 + 3 + ((1u << kDenoiseLevels) - 1);

/// Assumed angle of a pixel in radians, for a picture of `height` rows: the denoiser does not know the camera.
float denoisedPixelAngle(std::uint32_t height);

} // namespace pointrt
