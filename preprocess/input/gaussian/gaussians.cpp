// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/gaussian/gaussians.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "preprocess/input/gaussian/gaussian_discs.h"
#include "preprocess/input/gaussian/gaussian_transform.h"

namespace pointrt {
namespace {

/// A Gaussian's axes are at least this long relative to its longest. Rays are traced in units of the deviations, where
/// rounding errors of the long axes grow by the inverse of this ratio: by 2^10 of the 2^24 steps of a float, which
/// leaves 2^14 steps to a deviation. 2D Gaussians, whose third axis has no length, become this thin.
constexpr float kThinnest = 1.0f / 1024;

/// Whether a Gaussian can be kept; normalises its rotation, clamps its opacity to 0 to 1, and makes its axes no thinner
/// than kThinnest.
bool repair(Gaussian& gaussian, int harmonic_count) {
    const Eigen::Vector4d parts = gaussian.rotation.coeffs().cast<double>();
    const double length = parts.norm();
    const float longest = gaussian.deviations.maxCoeff();
    bool is_finite = gaussian.position.allFinite() && gaussian.deviations.allFinite() && std::isfinite(length) &&
                     gaussian.color.allFinite() && !std::isnan(gaussian.opacity);
    for (int i = 0; i < harmonic_count; ++i)
        is_finite = is_finite && gaussian.harmonics[static_cast<std::size_t>(i)].allFinite();
    if (!is_finite || length == 0 || !(longest > 0)) return false;
    gaussian.rotation.coeffs() = (parts / length).cast<float>();
    gaussian.deviations = gaussian.deviations.cwiseMax(kThinnest * longest);
    gaussian.opacity = std::clamp(gaussian.opacity, 0.0f, 1.0f);
    return gaussian.deviations.minCoeff() > 0;
}

ScanTraits keptTraits(const GaussianFile& file) {
    ScanTraits traits;
    traits.vertices = file.count;
    traits.normals = traits.colors = traits.radii = true;
    traits.normal_sides = traits.faces = false;
    const auto add = [&](const std::string& name, std::uint32_t components) {
        traits.columns.push_back({.name = name, .components = components, .required = true});
    };
    add(kGaussianOpacity, 1);
    add(kGaussianDeviation, 3);
    add(kGaussianRotation, 4);
    add(kGaussianColor, 3);
    for (int i = 1; i <= gaussianHarmonicCount(file.degree); ++i) add(gaussianHarmonicName(i), 3);
    return traits;
}

/// The values of keptTraits.
void pack(const Gaussian& gaussian, int harmonic_count, std::vector<float>& values) {
    const Eigen::Quaternionf& turn = gaussian.rotation;
    values = {gaussian.opacity};
    const auto add = [&](const Vec3f& three) { values.insert(values.end(), three.begin(), three.end()); };
    add(gaussian.deviations);
    values.insert(values.end(), {turn.w(), turn.x(), turn.y(), turn.z()});
    add(gaussian.color);
    for (int i = 0; i < harmonic_count; ++i) add(gaussian.harmonics[static_cast<std::size_t>(i)]);
}

/// The disc that programs without support for Gaussians show, in the frame of the scan: the sink transforms it.
Row discRow(const Gaussian& gaussian) {
    const GaussianDisc disc = discOf(gaussian);
    Row row{};
    for (int axis = 0; axis < 3; ++axis) {
        row[kX + axis] = gaussian.position[axis];
        row[kNormalX + axis] = disc.normal[axis];
        row[kRed + axis] = 255.0 * std::clamp(gaussian.color[axis], 0.0f, 1.0f);
    }
    row[kRadius] = disc.radius;
    return row;
}

void noteKept(const InputFile& input, const GaussianFile& file, std::uint64_t dropped, Sink& sink) {
    std::string text = fmt::format("holds {} Gaussians with spherical harmonics of degree {}, kept as they are",
                                   file.count, file.degree);
    if (dropped > 0)
        text += fmt::format("; left out: {} that are not finite or have no rotation or no extent", dropped);
    sink.note(input, text);
}

void keepGaussians(const InputFile& input, const GaussianFile& file, const EachGaussian& each, Sink& sink,
                   const std::string& title) {
    sink.beginScan(input, keptTraits(file));
    const GaussianTransform transform(input, sink.transform.linear(), file.degree);
    const int harmonic_count = gaussianHarmonicCount(file.degree);
    std::vector<float> values;
    std::uint64_t dropped = 0;
    each([&](const Gaussian& gaussian) {
        Row row = discRow(gaussian);
        Gaussian kept = gaussian;
        transform.apply(kept);
        if (!repair(kept, harmonic_count)) {
            ++dropped;
            row[kX] = std::numeric_limits<double>::quiet_NaN(); // the sink drops it and counts it as not finite
        }
        pack(kept, harmonic_count, values);
        sink.addVertex(row, reinterpret_cast<const char*>(values.data()));
    });
    if (file.count > 0 && dropped == file.count)
        refuse(input, fmt::format("none of its {} Gaussians is finite and has a rotation and an extent", file.count));
    noteKept(input, file, dropped, sink);
    sink.finishScan(input, title);
}

} // namespace

void noteHigherHarmonics(const InputFile& input, Sink& sink) {
    sink.note(input, "has spherical harmonics of degree 4: those up to degree 3 are read");
}

void readGaussianScan(const InputFile& input, const GaussianFile& file, const EachGaussian& each, Sink& sink,
                      const std::string& title) {
    if (sink.gaussians_as_discs)
        readAsDiscs(input, file, each, sink, title);
    else
        keepGaussians(input, file, each, sink, title);
}

void readGaussians(const InputFile& input, const GaussianFile& file, const EachGaussian& each, Sink& sink) {
    readGaussianScan(input, file, each, sink);
    WorldFrame frame;
    frame.up = file.up;
    frame.up_by_custom = true; // programs that train Gaussians keep whatever frame their cameras had
    sink.setWorldFrame(input, frame);
}

} // namespace pointrt
