// SPDX-License-Identifier: Apache-2.0
// The preview denoiser: an edge-avoiding filter guided by normal, depth, albedo and variance. It guesses: pictures to
// be measured are taken without it. Here it runs on what is on the device; picture_filter.h is for films of the host.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// Device buffers of a picture, 4 floats a pixel, rows from the top, each with a VK_FORMAT_R32G32B32A32_SFLOAT view.
struct DenoiseInputs {
    const Buffer* color = nullptr;   ///< linear rgb, alpha; where alpha is 0 the pixel stays as it is
    const Buffer* surface = nullptr; ///< normal (0: unknown), depth along the ray (0, negative, not finite: unknown)
    const Buffer* albedo = nullptr;  ///< linear albedo (1: unknown), variance of the mean luminance of rgb
    bool has_variance = true;        ///< false: albedo's fourth float is not read, variance is guessed from the picture
};

/// Everything to filter pictures of one size in one place, again and again. Free it with destroyDenoiser.
struct Denoiser {
    std::uint32_t width = 0, height = 0; ///< pixels; they may be set to less than it was made for, in all
    float pixel_angle = 0;               ///< radians
    Program prepare, clean, variance, level, last_level;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet prepare_set{}, clean_set{}, variance_set{}, last_set{};
    std::array<VkDescriptorSet, 2> level_sets{}; ///< [i] reads light[i] and writes the other one
    Buffer surface, slope, factor;               ///< see denoise_surface.glsl; what was divided out of the light
    std::array<Buffer, 2> light;                 ///< rgb and variance of the luminance, without albedo
    Buffer result;                               ///< 4 floats a pixel: filtered linear rgb, the input's alpha
};

/// For pictures of width x height pixels (at least 1) in the buffers of inputs, which must outlive the denoiser.
/// Takes 88 bytes of device memory a pixel. Throws Error kCannotRun where the device has not got them.
Denoiser createDenoiser(Device& device, std::uint32_t width, std::uint32_t height, const DenoiseInputs& inputs);
void destroyDenoiser(Device& device, Denoiser& denoiser);

/// Records the whole filter: inputs to denoiser.result. Ends with a barrier (recordBarrier); what wrote the inputs must
/// be behind one, too.
///
/// Method: the albedo is divided out; a single pixel that is over 6 times as bright as its second brightest neighbour
/// and whose deviation is over a quarter of its brightness takes that neighbour's brightness, so light is lost there;
/// then 5 levels of an a-trous wavelet with taps 1, 2, 4, 8 and 16 pixels apart, weighted by normal, distance from the
/// surface's plane, and luminance in terms of its variance; and the albedo is put back. Where the variance is 0 a pixel
/// keeps its light. Symmetric noise keeps its mean; of exponential noise at 4 samples 1.5% is lost. Pixels with alpha 0
/// are copied, partly covered ones are averaged with those of the same eighth of alpha only. Pixels that are no number
/// take the mean of the 8 around them; light over 1e9 times the albedo is cut there.
/// Dammertz et al., Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering, HPG 2010; Schied
/// et al., Spatiotemporal Variance-Guided Filtering, HPG 2017, without its temporal half.
void recordDenoise(VkCommandBuffer commands, const Denoiser& denoiser);

/// The same in steps 0 to kDenoiseSteps - 1 of about the same length, for those who have not got the time at once.
constexpr std::uint32_t kDenoiseLevels = 5, kDenoiseSteps = 3 + kDenoiseLevels;
void recordDenoiseStep(VkCommandBuffer commands, const Denoiser& denoiser, std::uint32_t step);

/// Pixels that are further away than this, in either direction, are not asked: 1 where single pixels are mended, 3
/// where the variance is estimated (denoise_variance.comp.glsl), and the levels' taps.
constexpr std::uint32_t kDenoiseReach = 1 + 3 + ((1u << kDenoiseLevels) - 1);

/// What a pixel of a picture so many pixels high is taken to measure: the denoiser does not know the camera.
float denoisedPixelAngle(std::uint32_t height);

} // namespace pointrt
