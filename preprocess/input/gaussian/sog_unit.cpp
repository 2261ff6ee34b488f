// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/gaussian/sog_unit.h"

#include <webp/decode.h>

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

/// Sets of harmonics in a row of their image, a pixel for each harmonic.
constexpr std::uint64_t kSetsOfRow = 64;

/// Images are nearly square and have few more pixels than Gaussians: at most this many times as many, plus this
/// constant, which suffices for all sets of harmonics.
constexpr std::uint64_t kPixelsPerGaussian = 4, kPixelsAtLeast = 1 << 20;

/// Opens an image and reads its header.
SogImage openImage(const SogFiles& files, const std::string& folder, const std::string& name) {
    SogImage image;
    image.file = files.open(folder, name);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(image.file.bytes.data());
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes, image.file.bytes.size(), &features) != VP8_STATUS_OK)
        refuse(image.file, "is not a WebP image, or is truncated");
    constexpr int kLossless = 2;
    if (features.has_animation != 0 || features.format != kLossless)
        refuse(image.file, "is not a lossless WebP image: its numbers are lost");
    image.width = static_cast<std::uint64_t>(features.width);
    image.height = static_cast<std::uint64_t>(features.height);
    return image;
}

void checkSize(const SogImage& image, std::uint64_t count) {
    if (image.pixelCount() < count)
        refuse(image.file,
               fmt::format("has {} x {} pixels, but there are {} Gaussians", image.width, image.height, count));
    if (image.pixelCount() > kPixelsAtLeast + kPixelsPerGaussian * count)
        refuse(image.file,
               fmt::format("has {} x {} pixels, too many for {} Gaussians", image.width, image.height, count));
}

void decodeImage(SogImage& image) {
    if (image.pixelCount() == 0) return;
    image.pixels.resize(4 * image.pixelCount());
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(image.file.bytes.data());
    if (!WebPDecodeRGBAInto(bytes, image.file.bytes.size(), image.pixels.data(), image.pixels.size(),
                            static_cast<int>(4 * image.width)))
        refuse(image.file, "the WebP data is invalid or truncated");
}

/// Means are stored as sign(x) log(|x| + 1).
double meanOf(double logarithm) { return std::copysign(std::expm1(std::abs(logarithm)), logarithm); }

/// The three smaller parts of w x y z in bytes from -sqrt(1/2) to sqrt(1/2), and the index of the largest as 252 to
/// 255.
Eigen::Quaternionf rotationOfBytes(const std::uint8_t* bytes) {
    constexpr int kFirstMark = 252;
    if (bytes[3] < kFirstMark) return Eigen::Quaternionf::Identity();
    const int largest = bytes[3] - kFirstMark;
    float parts[4] = {}, squares = 0;
    for (int i = 0, next = 0; i < 4; ++i) {
        if (i == largest) continue;
        parts[i] = (static_cast<float>(bytes[next++]) / 127.5f - 1) * std::sqrt(0.5f);
        squares += parts[i] * parts[i];
    }
    parts[largest] = std::sqrt(std::max(0.0f, 1 - squares));
    return {parts[0], parts[1], parts[2], parts[3]};
}

} // namespace

SogUnit::SogUnit(const SogFiles& files, const InputFile& meta_file, const std::string& folder)
    : meta_(parseSogMeta(meta_file)) {
    if (meta_.count == 0) refuse(meta_file, "holds no points");
    openImages(files, folder);
    checkImages();
    if (meta_.hasHarmonics()) checkHarmonics();
}

void SogUnit::openImages(const SogFiles& files, const std::string& folder) {
    const SogImageNames& names = meta_.images;
    means_low_ = openImage(files, folder, names.means_low);
    means_high_ = openImage(files, folder, names.means_high);
    quats_ = openImage(files, folder, names.quats);
    scales_ = openImage(files, folder, names.scales);
    colors_ = openImage(files, folder, names.colors);
    if (!meta_.hasHarmonics()) return;
    centroids_ = openImage(files, folder, names.centroids);
    labels_ = openImage(files, folder, names.labels);
}

void SogUnit::checkImages() const {
    for (const SogImage* image : {&means_low_, &means_high_, &quats_, &scales_, &colors_, &labels_})
        if (!image->file.bytes.empty()) checkSize(*image, meta_.count);
}

/// The width of the image gives the degree, which version 1 does not state.
void SogUnit::checkHarmonics() {
    for (int degree = 1; degree <= 3; ++degree)
        if (centroids_.width == kSetsOfRow * static_cast<std::uint64_t>(gaussianHarmonicCount(degree)))
            degree_ = degree;
    if (degree_ == 0 || (meta_.degree != 0 && meta_.degree != degree_))
        refuse(centroids_.file, fmt::format("is {} pixels wide; spherical harmonics of degree 1, 2 and 3 need 192, 512 "
                                            "and 960",
                                            centroids_.width));
    checkSize(centroids_, 0);
    const std::uint64_t held = kSetsOfRow * centroids_.height;
    meta_.palette = meta_.palette == 0 ? held : std::min(meta_.palette, held);
}

void SogUnit::decode() {
    for (SogImage* image : {&means_low_, &means_high_, &quats_, &scales_, &colors_, &centroids_, &labels_})
        decodeImage(*image);
}

Gaussian SogUnit::at(std::uint64_t index) const {
    const std::uint8_t *const low = means_low_.at(index), *const high = means_high_.at(index),
                              *const scale = scales_.at(index), *const color = colors_.at(index);
    Gaussian gaussian;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        const double share = (low[axis] | high[axis] << 8) / 65535.0;
        const double span = meta_.high[i] - meta_.low[i];
        gaussian.position[i] = meanOf(meta_.low[i] + span * share);
        gaussian.deviations[i] = std::exp(meta_.scales[axis][scale[axis]]);
        gaussian.color[i] = colorOfHarmonic(static_cast<double>(meta_.colors[axis][color[axis]]));
    }
    gaussian.opacity = meta_.opacities[color[3]];
    gaussian.rotation = rotationOfBytes(quats_.at(index));
    if (degree_ > 0) readHarmonicsOf(index, gaussian);
    return gaussian;
}

void SogUnit::readHarmonicsOf(std::uint64_t index, Gaussian& gaussian) const {
    const std::uint8_t* const label = labels_.at(index);
    const auto set = static_cast<std::uint64_t>(label[0] | label[1] << 8);
    if (set >= meta_.palette) return;
    const auto count = static_cast<std::uint64_t>(gaussianHarmonicCount(degree_));
    const std::uint64_t first = set / kSetsOfRow * centroids_.width + set % kSetsOfRow * count;
    for (std::uint64_t k = 0; k < count; ++k)
        for (std::size_t channel = 0; channel < 3; ++channel)
            gaussian.harmonics[k][static_cast<Eigen::Index>(channel)] =
                meta_.harmonics[centroids_.at(first + k)[channel]];
}

} // namespace pointrt
