// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/ply_gaussians.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "preprocess/input/gaussians.h"
#include "preprocess/input/ply_body.h"

namespace pointrt {
namespace {

/// Reads selected properties of an element by number; all others share the last number.
struct Wanted {
    std::vector<std::size_t> number_of_property;
    std::vector<double> values;

    Wanted(const PlyElement& element, std::span<const char* const> names) : values(names.size() + 1) {
        for (const PlyProperty& property : element.properties) {
            const auto found = std::find(names.begin(), names.end(), property.name);
            const auto number = static_cast<std::size_t>(found - names.begin());
            number_of_property.push_back(property.is_list ? names.size() : number);
        }
    }

    template <typename Values>
    void read(PlyBody<Values>& body, const PlyElement& element, std::uint64_t index) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (property.is_list)
                body.skip(element, index, property);
            else
                body.value(element, index, property.type, values[number_of_property[i]]);
        }
    }
};

/// Trained parameters: log standard deviations, logit opacities, harmonic colours.
enum Plain { kCentre, kColor = 3, kOpacity = 6, kScale = 7, kRotation = 10, kPlainCount = 14 };
constexpr std::array<const char*, kPlainCount> kPlainNames = {"x",      "y",       "z",       "f_dc_0",  "f_dc_1",
                                                              "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2",
                                                              "rot_0",  "rot_1",   "rot_2",   "rot_3"};

Gaussian gaussianOf(const std::vector<double>& values) {
    Gaussian gaussian;
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = [&](Plain first) { return values[static_cast<std::size_t>(first + axis)]; };
        gaussian.position[axis] = value(kCentre);
        gaussian.deviations[axis] = std::exp(static_cast<float>(value(kScale)));
        gaussian.color[axis] = static_cast<float>(0.5 + kConstantHarmonic * value(kColor));
    }
    const auto part = [&](int i) { return static_cast<float>(values[static_cast<std::size_t>(kRotation + i)]); };
    gaussian.rotation = Eigen::Quaternionf(part(0), part(1), part(2), part(3));
    gaussian.opacity = sigmoid(static_cast<float>(values[kOpacity]));
    return gaussian;
}

/// Calls use for the elements in order, up to and including the vertices.
template <typename Use>
void forElementsUpToVertices(const PlyHeader& header, const Use& use) {
    for (const PlyElement& element : header.elements) {
        use(element);
        if (element.name == "vertex") return;
    }
}

EachGaussian plainGaussians(const InputFile& input, const PlyHeader& header) {
    return [&](const std::function<void(const Gaussian&)>& use) {
        const bool is_flat =
            std::none_of(vertexElement(header).properties.begin(), vertexElement(header).properties.end(),
                         [](const PlyProperty& property) { return property.name == "scale_2"; });
        withPlyBody(input, header, [&](auto body) {
            forElementsUpToVertices(header, [&](const PlyElement& element) {
                if (element.name != "vertex") return body.skipElement(element);
                Wanted wanted(element, kPlainNames);
                for (std::uint64_t i = 0; i < element.count; ++i) {
                    wanted.read(body, element, i);
                    Gaussian gaussian = gaussianOf(wanted.values);
                    if (is_flat) gaussian.deviations.z() = 0;
                    use(gaussian);
                }
            });
        });
    };
}

/// This many splats of a packed file share a chunk, which holds the range of each of their parameters.
constexpr std::uint64_t kSplatsOfChunk = 256;
enum OfChunk { kCentreRange, kScaleRange = 6, kColorRange = 12, kChunkCount = 18 };
constexpr std::array<const char*, kChunkCount> kChunkNames = {
    "min_x",       "min_y",       "min_z",       "max_x", "max_y", "max_z", "min_scale_x", "min_scale_y", "min_scale_z",
    "max_scale_x", "max_scale_y", "max_scale_z", "min_r", "min_g", "min_b", "max_r",       "max_g",       "max_b"};
using Chunk = std::array<float, kChunkCount>;

enum Packed { kPackedCentre, kPackedRotation, kPackedScale, kPackedColor, kPackedCount };
constexpr std::array<const char*, kPackedCount> kPackedNames = {"packed_position", "packed_rotation", "packed_scale",
                                                                "packed_color"};

float share(std::uint32_t bits, int shift, int size) {
    const std::uint32_t most = (1u << size) - 1;
    return static_cast<float>(bits >> shift & most) / static_cast<float>(most);
}

/// Unpacks 11, 10 and 11 bits.
Vec3f sharesOf(std::uint32_t bits) { return {share(bits, 21, 11), share(bits, 11, 10), share(bits, 0, 11)}; }

Vec3f within(const Chunk& chunk, OfChunk range, const Vec3f& shares) {
    const Eigen::Map<const Vec3f> low(chunk.data() + range), high(chunk.data() + range + 3);
    return low.cwiseProduct(Vec3f::Ones() - shares) + high.cwiseProduct(shares);
}

/// 2 bits: index of the largest of w x y z; then the others in 10 bits each, from -sqrt(1/2) to sqrt(1/2).
Eigen::Quaternionf rotationOf(std::uint32_t bits) {
    std::array<float, 4> parts{};
    const std::size_t largest = bits >> 30;
    float squares = 0;
    int shift = 20;
    for (std::size_t i = 0; i < 4; ++i) {
        if (i == largest) continue;
        parts[i] = (share(bits, shift, 10) - 0.5f) * std::sqrt(2.0f);
        squares += parts[i] * parts[i];
        shift -= 10;
    }
    parts[largest] = std::sqrt(std::max(0.0f, 1 - squares));
    return {parts[0], parts[1], parts[2], parts[3]};
}

Gaussian unpack(const Chunk& chunk, const std::vector<double>& values) {
    const auto bits = [&](Packed which) { return static_cast<std::uint32_t>(values[which]); };
    Gaussian gaussian;
    gaussian.position = within(chunk, kCentreRange, sharesOf(bits(kPackedCentre))).cast<double>();
    gaussian.deviations = within(chunk, kScaleRange, sharesOf(bits(kPackedScale))).array().exp();
    gaussian.rotation = rotationOf(bits(kPackedRotation));
    const std::uint32_t color = bits(kPackedColor);
    gaussian.color = within(chunk, kColorRange, {share(color, 24, 8), share(color, 16, 8), share(color, 8, 8)});
    gaussian.opacity = share(color, 0, 8);
    return gaussian;
}

std::uint64_t chunksOf(const PlyHeader& header) {
    return (vertexElement(header).count + kSplatsOfChunk - 1) / kSplatsOfChunk;
}

template <typename Values>
std::vector<Chunk> readChunks(PlyBody<Values>& body, const PlyElement& element, std::uint64_t needed) {
    if (element.count != needed)
        refuse(body.input, fmt::format("has {} chunks of packed splats, but needs {}", element.count, needed));
    Wanted wanted(element, kChunkNames);
    std::fill(wanted.values.begin() + kColorRange + 3, wanted.values.end(),
              1.0); // older files have no colour range
    std::vector<Chunk> chunks(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        wanted.read(body, element, i);
        std::transform(wanted.values.begin(), wanted.values.end() - 1, chunks[i].begin(),
                       [](double value) { return static_cast<float>(value); });
    }
    return chunks;
}

EachGaussian packedGaussians(const InputFile& input, const PlyHeader& header) {
    return [&](const std::function<void(const Gaussian&)>& use) {
        withPlyBody(input, header, [&](auto body) {
            std::vector<Chunk> chunks;
            forElementsUpToVertices(header, [&](const PlyElement& element) {
                if (element.name == "chunk") chunks = readChunks(body, element, chunksOf(header));
                if (element.name != "vertex" && element.name != "chunk") body.skipElement(element);
                if (element.name != "vertex") return;
                if (chunks.size() != chunksOf(header))
                    refuse(input, fmt::format("has no chunks before its {} packed splats", element.count));
                Wanted wanted(element, kPackedNames);
                for (std::uint64_t i = 0; i < element.count; ++i) {
                    wanted.read(body, element, i);
                    use(unpack(chunks[i / kSplatsOfChunk], wanted.values));
                }
            });
        });
    };
}

/// Requires the packed properties to be 32-bit words.
void checkPacked(const InputFile& input, const PlyElement& vertex) {
    for (const PlyProperty& property : vertex.properties)
        if (property.name.starts_with("packed_") && (property.is_list || property.type != Scalar::kU32))
            refuse(input, fmt::format("{} must have type uint", inQuotes(property.name)));
}

/// Whether there is view-dependent colour, in vertex properties or in an element of its own.
bool hasHarmonics(const PlyHeader& header) {
    for (const PlyElement& element : header.elements)
        for (const PlyProperty& property : element.properties)
            if (property.name.starts_with("f_rest_")) return true;
    return false;
}

} // namespace

void readPlyGaussians(const InputFile& input, const PlyHeader& header, Sink& sink) {
    const bool packed = header.gaussians == PlyGaussians::kPacked;
    if (packed) checkPacked(input, vertexElement(header));
    GaussianFile file;
    file.count = vertexElement(header).count;
    file.up = -Vec3d::UnitY(); // the camera frame of photogrammetry: y down, z forwards
    if (hasHarmonics(header)) file.lost = "view-dependent colour";
    readGaussians(input, file, packed ? packedGaussians(input, header) : plainGaussians(input, header), sink);
}

} // namespace pointrt
