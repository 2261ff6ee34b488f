// SPDX-License-Identifier: GPL-3.0-or-later
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_gaussian_splatting
#include "preprocess/input/mesh/gltf_gaussians.h"

#include <algorithm>
#include <cmath>

#include "preprocess/cloud/srgb.h"
#include "preprocess/ingest/gzip.h"
#include "preprocess/input/gaussian/gaussian_transform.h"
#include "preprocess/input/gaussian/spz_gaussian.h"
#include "preprocess/input/mesh/gltf_accessor.h"

namespace pointrt {
namespace {

constexpr const char* kSplatting = "KHR_gaussian_splatting";

/// The Gaussians of one primitive, untransformed.
struct GaussianPart {
    std::uint64_t count = 0;
    int degree = 0;
    std::function<Gaussian(std::uint64_t)> at;
};

/// The bufferView with an SPZ file: in extensions of the base extension or, in the first draft, beside it.
std::optional<JsonValue> spzView(const GltfPart& part) {
    if (const auto first_draft = part.extension("KHR_spz_gaussian_splats_compression"))
        return first_draft->member("bufferView");
    const auto splatting = part.extension(kSplatting);
    const auto extensions = splatting ? splatting->optionalMember("extensions") : std::nullopt;
    if (!extensions) return std::nullopt;
    for (const char* const name :
         {"KHR_gaussian_splatting_compression_spz_2", "KHR_gaussian_splatting_compression_spz"})
        if (const auto draft = extensions->optionalMember(name)) return draft->member("bufferView");
    return std::nullopt;
}

/// The axes of the SPZ file are kept, as in Cesium, whose tiles are most of these files: up is y in both.
GaussianPart spzPart(const GltfFile& file, const JsonValue& view, Sink& sink) {
    struct Opened {
        InputFile input;
        SpzFile spz;
    };
    auto opened = std::make_shared<Opened>();
    opened->input = file.input();
    opened->input.bytes = file.view(view).bytes;
    if (isGzip(opened->input.bytes)) unpackGzip(opened->input);
    opened->spz = openSpz(opened->input);
    if (opened->spz.harmonics_degree > spzDegree(opened->spz)) noteHigherHarmonics(file.input(), sink);
    return {opened->spz.count, spzDegree(opened->spz),
            [opened](std::uint64_t index) { return spzGaussian(opened->spz, index); }};
}

/// The accessors of one primitive.
struct SplatAccessors {
    GltfAccessor position, rotation, scale, opacity;
    std::vector<GltfAccessor> harmonics; ///< the constant one first
    bool is_linear = false;              ///< colours are linear, not display-encoded

    Gaussian at(std::uint64_t index) const;
};

/// Colours around the constant one, to first order: they are stored for one encoding and displayed in the other.
void encodeForDisplay(Gaussian& gaussian) {
    for (int channel = 0; channel < 3; ++channel) {
        const auto linear = static_cast<double>(std::max(gaussian.color[channel], 0.0f));
        gaussian.color[channel] = static_cast<float>(srgbFromLinear(linear));
        const auto slope = static_cast<float>(srgbSlope(linear));
        for (Vec3f& harmonic : gaussian.harmonics) harmonic[channel] *= slope;
    }
}

Gaussian SplatAccessors::at(std::uint64_t index) const {
    Gaussian gaussian;
    gaussian.position = position.three(index);
    gaussian.deviations = scale.three(index).cast<float>();
    const auto part = [&](int i) { return static_cast<float>(rotation.value(index, i)); };
    gaussian.rotation = Eigen::Quaternionf(part(3), part(0), part(1), part(2));
    gaussian.opacity = static_cast<float>(opacity.value(index, 0));
    const Vec3d constant = harmonics.front().three(index);
    for (int channel = 0; channel < 3; ++channel) gaussian.color[channel] = colorOfHarmonic(constant[channel]);
    for (std::size_t k = 1; k < harmonics.size(); ++k)
        gaussian.harmonics[k - 1] = harmonics[k].three(index).cast<float>();
    if (is_linear) encodeForDisplay(gaussian);
    return gaussian;
}

std::string splattingName(const std::string& name) { return std::string(kSplatting) + ":" + name; }

std::string harmonicName(int degree, int coefficient) {
    return splattingName(fmt::format("SH_DEGREE_{}_COEF_{}", degree, coefficient));
}

/// The highest degree of which no harmonic is missing.
int degreeOf(const JsonValue& attributes) {
    for (int degree = 1; degree <= 3; ++degree)
        for (int k = 0; k <= 2 * degree; ++k)
            if (!attributes.has(harmonicName(degree, k).c_str())) return degree - 1;
    return 3;
}

GaussianPart plainPart(const GltfFile& file, const GltfPart& part, Sink& sink) {
    const JsonValue attributes = part.primitive.member("attributes");
    const auto accessor = [&](const std::string& name, int components) {
        return GltfAccessor(file, attributes.member(name.c_str()), components);
    };
    auto splats = std::make_shared<SplatAccessors>(SplatAccessors{accessor("POSITION", 3),
                                                                  accessor(splattingName("ROTATION"), 4),
                                                                  accessor(splattingName("SCALE"), 3),
                                                                  accessor(splattingName("OPACITY"), 1),
                                                                  {}});
    const int degree = degreeOf(attributes);
    for (int d = 0; d <= degree; ++d)
        for (int k = 0; k <= 2 * d; ++k) splats->harmonics.push_back(accessor(harmonicName(d, k), 3));
    const std::uint64_t count = splats->position.count();
    std::uint64_t fewest = std::min({count, splats->rotation.count(), splats->scale.count(), splats->opacity.count()});
    for (const GltfAccessor& harmonic : splats->harmonics) fewest = std::min(fewest, harmonic.count());
    if (fewest < count)
        attributes.refuse(fmt::format("have {} positions, but other values for only {} of them", count, fewest));
    const auto space = part.extension(kSplatting)->optionalMember("colorSpace");
    splats->is_linear = space && space->text() == "lin_rec709_display";
    if (splats->is_linear)
        sink.note(file.input(),
                  "has Gaussians with linear colours: these are converted and blended as display-encoded colours");
    return {count, degree, [splats](std::uint64_t index) { return splats->at(index); }};
}

void checkKernel(const GltfPart& part) {
    const auto splatting = part.extension(kSplatting);
    const auto kernel = splatting ? splatting->optionalMember("kernel") : std::nullopt;
    if (kernel && kernel->text() != "ellipse")
        kernel->refuse(fmt::format("is {}; this build reads 'ellipse'", inQuotes(kernel->text())));
}

/// A primitive's Gaussians and where its node places them.
struct PlacedGaussians {
    GaussianPart part;
    Eigen::Affine3d input_from_part;
    GaussianTransform transform;

    Gaussian at(std::uint64_t index) const {
        Gaussian gaussian = part.at(index);
        gaussian.position = input_from_part * gaussian.position;
        transform.apply(gaussian);
        return gaussian;
    }
};

PlacedGaussians placedGaussians(const GltfFile& file, const GltfPart& part, Sink& sink) {
    checkKernel(part);
    const auto view = spzView(part);
    GaussianPart gaussians = view ? spzPart(file, *view, sink) : plainPart(file, part, sink);
    const GaussianTransform transform(file.input(), part.input_from_part.linear(), gaussians.degree);
    return {std::move(gaussians), part.input_from_part, transform};
}

} // namespace

bool areGaussians(const GltfPart& part) {
    return part.extension(kSplatting) || part.extension("KHR_spz_gaussian_splats_compression");
}

void readGltfGaussians(const GltfFile& file, const std::vector<GltfPart>& parts, const std::string& title, Sink& sink) {
    std::vector<PlacedGaussians> placed;
    GaussianFile all;
    for (const GltfPart& part : parts) {
        placed.push_back(placedGaussians(file, part, sink));
        all.count += placed.back().part.count;
        all.degree = std::max(all.degree, placed.back().part.degree);
    }
    const auto each = [&](const std::function<void(const Gaussian&)>& use) {
        for (const PlacedGaussians& one : placed)
            for (std::uint64_t i = 0; i < one.part.count; ++i) use(one.at(i));
    };
    readGaussianScan(file.input(), all, each, sink, title);
}

} // namespace pointrt
