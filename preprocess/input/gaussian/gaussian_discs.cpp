// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/gaussian/gaussian_discs.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointrt {
namespace {

/// Gaussians fainter than this are more air than surface. In a trained model of a person they are 55 % of all
/// Gaussians, but 9 % of the covered area; at 0.5 (78 % and 24 %) holes appear, and at 0.1 a fur of faint ones hides
/// the face.
constexpr float kLeastOpacity = 0.2f;

/// The shortest axis is used as normal only if it is much shorter than the next one; otherwise the neighbours give a
/// better estimate.
constexpr float kFlattest = 0.3f;

/// Skies and far backgrounds are shells of a few huge Gaussians, which as discs would hide what lies before them.
/// Gaussians are dropped if their radius exceeds this share of the longest edge of the box around all centres but the
/// outermost hundredths.
constexpr double kLargestShare = 0.25, kOutermost = 0.01;

/// The box is measured from at most this many centres.
constexpr std::uint64_t kMeasured = 1 << 16;

/// The longest edge of the box that holds all but the outermost centres.
double sizeOf(const GaussianFile& file, const EachGaussian& each) {
    const std::uint64_t step = file.count / kMeasured + 1;
    std::array<std::vector<double>, 3> centres;
    std::uint64_t index = 0;
    each([&](const Gaussian& gaussian) {
        if (index++ % step != 0 || gaussian.opacity < kLeastOpacity || !gaussian.position.allFinite()) return;
        for (int axis = 0; axis < 3; ++axis) centres[axis].push_back(gaussian.position[axis]);
    });
    double longest = 0;
    for (std::vector<double>& values : centres) {
        if (values.empty()) return 0;
        std::sort(values.begin(), values.end());
        const auto outermost = static_cast<std::size_t>(kOutermost * static_cast<double>(values.size()));
        longest = std::max(longest, values[values.size() - 1 - outermost] - values[outermost]);
    }
    return longest;
}

struct LeftOut {
    std::uint64_t faint = 0, huge = 0;
};

void noteLosses(const InputFile& input, const GaussianFile& file, const LeftOut& left_out, Sink& sink) {
    const std::string lost =
        file.degree == 0 ? "transparency and elongation" : "transparency, elongation and view-dependent colour";
    std::string text =
        fmt::format("Gaussian splats are read as opaque round discs of radius {} standard deviations, without {}",
                    kRadiusDeviations, lost);
    std::string left;
    if (left_out.faint > 0)
        left = fmt::format("{} of {} with an opacity below {}", left_out.faint, file.count, kLeastOpacity);
    if (left_out.huge > 0)
        left += fmt::format("{}{} with a radius above a quarter of the scene's size", left.empty() ? "" : " and ",
                            left_out.huge);
    if (!left.empty()) text += "; left out: " + left;
    sink.note(input, text);
}

ScanTraits discTraits(std::uint64_t count) {
    ScanTraits traits;
    traits.vertices = count;
    traits.normals = traits.colors = traits.radii = true;
    traits.normal_sides = traits.faces = false;
    traits.columns.push_back({kGaussianOpacity, Scalar::kF32});
    return traits;
}

} // namespace

GaussianDisc discOf(const Gaussian& gaussian) {
    GaussianDisc disc;
    const Vec3f& deviations = gaussian.deviations;
    if (!deviations.allFinite()) return disc;
    std::array<int, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return deviations[a] < deviations[b]; });
    const float flat = deviations[order[0]], middle = deviations[order[1]], longest = deviations[order[2]];
    // The disc's radius is between the ellipse's width and the radius of a disc with its area. Typical ellipses are 4
    // times as long as wide: discs of their area would stick out at all edges, and discs of their width would leave
    // gaps.
    disc.radius = kRadiusDeviations * std::cbrt(middle * middle * longest);
    disc.is_flat = flat < kFlattest * middle;
    const float length = gaussian.rotation.norm();
    if (length > 0 && std::isfinite(length)) disc.normal = gaussian.rotation.normalized() * Vec3f::Unit(order[0]);
    return disc;
}

void readAsDiscs(const InputFile& input, const GaussianFile& file, const EachGaussian& each, Sink& sink,
                 const std::string& title) {
    const double largest = kLargestShare * sizeOf(file, each);
    sink.beginScan(input, discTraits(file.count));
    LeftOut left_out;
    Row row{};
    each([&](const Gaussian& gaussian) {
        const GaussianDisc disc = discOf(gaussian);
        const bool faint = !(gaussian.opacity >= kLeastOpacity), huge = largest > 0 && disc.radius > largest;
        left_out.faint += faint;
        left_out.huge += !faint && huge;
        if (faint || huge) return sink.skipVertex();
        for (int axis = 0; axis < 3; ++axis) {
            row[kX + axis] = gaussian.position[axis];
            row[kNormalX + axis] = disc.is_flat ? disc.normal[axis] : 0.0f;
            row[kRed + axis] = 255.0 * std::clamp(gaussian.color[axis], 0.0f, 1.0f);
        }
        row[kRadius] = disc.radius;
        sink.addVertex(row, reinterpret_cast<const char*>(&gaussian.opacity));
    });
    if (left_out.huge > 0 && left_out.faint + left_out.huge == file.count)
        refuse(input,
               fmt::format("none of its {} Gaussian splats makes a disc: {} have a radius above a quarter of the "
                           "scene's size, and the others have an opacity below {}",
                           file.count, left_out.huge, kLeastOpacity));
    if (file.count > 0 && left_out.faint == file.count)
        refuse(input,
               fmt::format("none of its {} Gaussian splats has an opacity of {} or more", file.count, kLeastOpacity));
    noteLosses(input, file, left_out, sink);
    sink.finishScan(input, title);
}

} // namespace pointrt
