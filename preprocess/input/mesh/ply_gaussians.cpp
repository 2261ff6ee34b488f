// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/ply_gaussians.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "preprocess/input/gaussian/gaussians.h"
#include "preprocess/input/mesh/ply_body.h"

namespace pointrt {
namespace {

/// Reads selected properties of an element by number; all others share the last number.
struct Wanted {
    std::vector<std::size_t> number_of_property;
    std::vector<double> values;

    Wanted(const PlyElement& element, std::span<const std::string> names) : values(names.size() + 1) {
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

constexpr std::string_view kRestPrefix = "f_rest_";

/// The view-dependent colours of a file: f_rest_0, f_rest_1 ..., all of red, then green, then blue.
struct RestLayout {
    const PlyElement* element = nullptr; ///< the element with these properties; null: none
    std::size_t count = 0;               ///< of properties
    int degree = 0;                      ///< degree that is read, 0 to 3

    explicit RestLayout(const PlyHeader& header) {
        for (const PlyElement& each : header.elements) {
            const auto found = std::count_if(each.properties.begin(), each.properties.end(),
                                             [](const PlyProperty& one) { return one.name.starts_with(kRestPrefix); });
            if (found == 0) continue;
            element = &each;
            count = static_cast<std::size_t>(found);
        }
        for (int d = 1; d <= kHighestDegree; ++d)
            if (count == 3 * static_cast<std::size_t>(gaussianHarmonicCount(d))) degree = std::min(d, 3);
    }

    /// Some programs train with degree 4, of which the harmonics up to degree 3 are read.
    static constexpr int kHighestDegree = 4;

    /// Appends the names of all properties, if they are read.
    void addNames(std::vector<std::string>& names) const {
        for (std::size_t i = 0; degree > 0 && i < count; ++i) names.push_back(fmt::format("{}{}", kRestPrefix, i));
    }

    /// Sets the harmonics from the values of the names.
    void read(std::span<const double> values, Gaussian& gaussian) const {
        for (int k = 0; k < gaussianHarmonicCount(degree); ++k)
            for (int channel = 0; channel < 3; ++channel)
                gaussian.harmonics[static_cast<std::size_t>(k)][channel] = static_cast<float>(
                    values[static_cast<std::size_t>(channel) * (count / 3) + static_cast<std::size_t>(k)]);
    }
};

/// Trained parameters: log standard deviations, logit opacities, and harmonic colours or plain ones.
enum Plain { kCentre, kColor = 3, kOpacity = 6, kScale = 7, kRotation = 10, kPlainCount = 14 };

std::vector<std::string> plainNames(bool harmonic_colors) {
    std::vector<std::string> names = {"x", "y", "z"};
    for (const char* name : {"f_dc_0", "f_dc_1", "f_dc_2"})
        if (harmonic_colors) names.emplace_back(name);
    for (const char* name : {"red", "green", "blue"})
        if (!harmonic_colors) names.emplace_back(name);
    for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
        names.emplace_back(name);
    return names;
}

/// The vertices of a file with one property for each parameter.
struct PlainGaussians {
    const PlyElement& vertex;
    RestLayout rest;
    bool harmonic_colors; ///< the colours are f_dc_0 to f_dc_2; else red, green and blue, as nerfstudio writes
    bool is_flat;         ///< 2D Gaussians
    double color_scale;   ///< of red, green and blue: a whole colour

    explicit PlainGaussians(const PlyHeader& header)
        : vertex(vertexElement(header)), rest(header), harmonic_colors(hasHarmonicColors(vertex)),
          is_flat(!hasProperty(vertex, "scale_2")), color_scale(harmonic_colors ? 1 : wholeColor(vertex)) {
        if (rest.element != &vertex) rest.degree = 0;
    }

    static bool hasHarmonicColors(const PlyElement& vertex) {
        return hasProperty(vertex, "f_dc_0") && hasProperty(vertex, "f_dc_1") && hasProperty(vertex, "f_dc_2");
    }

    static double wholeColor(const PlyElement& vertex) {
        const auto red = std::find_if(vertex.properties.begin(), vertex.properties.end(),
                                      [](const PlyProperty& each) { return each.name == "red"; });
        if (isReal(red->type)) return 1;
        return red->type == Scalar::kU16 ? 0xffff : 0xff;
    }

    std::vector<std::string> names() const {
        std::vector<std::string> all = plainNames(harmonic_colors);
        rest.addNames(all);
        return all;
    }

    /// values: of the names
    Gaussian gaussianOf(const std::vector<double>& values) const {
        Gaussian gaussian;
        for (int axis = 0; axis < 3; ++axis) {
            const auto value = [&](Plain first) { return values[static_cast<std::size_t>(first + axis)]; };
            gaussian.position[axis] = value(kCentre);
            gaussian.deviations[axis] = std::exp(static_cast<float>(value(kScale)));
            gaussian.color[axis] =
                harmonic_colors ? colorOfHarmonic(value(kColor)) : static_cast<float>(value(kColor) / color_scale);
        }
        if (is_flat) gaussian.deviations.z() = 0;
        const auto part = [&](int i) { return static_cast<float>(values[static_cast<std::size_t>(kRotation + i)]); };
        gaussian.rotation = Eigen::Quaternionf(part(0), part(1), part(2), part(3));
        gaussian.opacity = sigmoid(static_cast<float>(values[kOpacity]));
        rest.read(std::span(values).subspan(kPlainCount), gaussian);
        return gaussian;
    }
};

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
        const PlainGaussians gaussians(header);
        withPlyBody(input, header, [&](auto body) {
            forElementsUpToVertices(header, [&](const PlyElement& element) {
                if (element.name != "vertex") return body.skipElement(element);
                Wanted wanted(element, gaussians.names());
                for (std::uint64_t i = 0; i < element.count; ++i) {
                    wanted.read(body, element, i);
                    use(gaussians.gaussianOf(wanted.values));
                }
            });
        });
    };
}

/// This many splats of a packed file share a chunk, which holds the range of each of their parameters.
constexpr std::uint64_t kSplatsOfChunk = 256;
enum OfChunk { kCentreRange, kScaleRange = 6, kColorRange = 12, kChunkCount = 18 };
const std::array<std::string, kChunkCount> kChunkNames = {
    "min_x",       "min_y",       "min_z",       "max_x", "max_y", "max_z", "min_scale_x", "min_scale_y", "min_scale_z",
    "max_scale_x", "max_scale_y", "max_scale_z", "min_r", "min_g", "min_b", "max_r",       "max_g",       "max_b"};
using Chunk = std::array<float, kChunkCount>;

enum Packed { kPackedCentre, kPackedRotation, kPackedScale, kPackedColor, kPackedCount };
const std::array<std::string, kPackedCount> kPackedNames = {"packed_position", "packed_rotation", "packed_scale",
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

/// Reads the view-dependent colours of packed splats together with these, although they are in a later element.
template <typename Values>
class PackedHarmonics {
public:
    /// body: at the vertices
    PackedHarmonics(const RestLayout& rest, const PlyHeader& header, const PlyBody<Values>& body)
        : rest_(rest), body_(body) {
        if (rest.degree == 0) return;
        std::vector<std::string> names;
        rest.addNames(names);
        wanted_.emplace(*rest.element, names);
        const PlyElement* element = &vertexElement(header);
        for (; element != rest.element; ++element) body_.skipElement(*element);
    }

    /// Eight units on either side of 0, in bytes; the lowest and the highest byte stand for the ends.
    void read(std::uint64_t index, Gaussian& gaussian) {
        if (!wanted_) return;
        wanted_->read(body_, *rest_.element, index);
        for (double& value : wanted_->values) {
            const double share = value == 0 ? 0 : value == 255 ? 1 : (value + 0.5) / 256;
            value = 8 * (share - 0.5);
        }
        rest_.read(wanted_->values, gaussian);
    }

private:
    const RestLayout& rest_;
    PlyBody<Values> body_;
    std::optional<Wanted> wanted_;
};

/// Requires as many view-dependent colours as splats, in bytes, after these.
RestLayout packedRest(const InputFile& input, const PlyHeader& header) {
    RestLayout rest(header);
    if (rest.degree == 0) return rest;
    const PlyElement& vertex = vertexElement(header);
    for (const PlyProperty& property : rest.element->properties)
        if (property.is_list || property.type != Scalar::kU8)
            refuse(input, fmt::format("{} must have type uchar", inQuotes(property.name)));
    if (rest.element <= &vertex || rest.element->count != vertex.count)
        refuse(input, fmt::format("has {} packed splats, but not as many {} after them", vertex.count,
                                  pluralOf(*rest.element)));
    return rest;
}

EachGaussian packedGaussians(const InputFile& input, const PlyHeader& header) {
    return [&](const std::function<void(const Gaussian&)>& use) {
        const RestLayout rest = packedRest(input, header);
        withPlyBody(input, header, [&]<typename Values>(PlyBody<Values> body) {
            std::vector<Chunk> chunks;
            forElementsUpToVertices(header, [&](const PlyElement& element) {
                if (element.name == "chunk") chunks = readChunks(body, element, chunksOf(header));
                if (element.name != "vertex" && element.name != "chunk") body.skipElement(element);
                if (element.name != "vertex") return;
                if (chunks.size() != chunksOf(header))
                    refuse(input, fmt::format("has no chunks before its {} packed splats", element.count));
                Wanted wanted(element, kPackedNames);
                PackedHarmonics<Values> harmonics(rest, header, body);
                for (std::uint64_t i = 0; i < element.count; ++i) {
                    wanted.read(body, element, i);
                    Gaussian gaussian = unpack(chunks[i / kSplatsOfChunk], wanted.values);
                    harmonics.read(i, gaussian);
                    use(gaussian);
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

/// Notes which view-dependent colours are not read.
void noteRest(const InputFile& input, const RestLayout& rest, Sink& sink) {
    if (rest.count > 0 && rest.degree == 0)
        sink.note(input,
                  fmt::format("has {} properties 'f_rest_...', which are ignored: spherical harmonics of degree 1, "
                              "2 and 3 have 9, 24 and 45",
                              rest.count));
    else if (rest.count > 3 * static_cast<std::size_t>(kMostGaussianHarmonics))
        noteHigherHarmonics(input, sink);
}

} // namespace

void readPlyGaussians(const InputFile& input, const PlyHeader& header, Sink& sink) {
    const bool packed = header.gaussians == PlyGaussians::kPacked;
    if (packed) checkPacked(input, vertexElement(header));
    const RestLayout rest = packed ? packedRest(input, header) : PlainGaussians(header).rest;
    noteRest(input, rest, sink);
    GaussianFile file;
    file.count = vertexElement(header).count;
    file.up = -Vec3d::UnitY(); // the camera frame of photogrammetry: y down, z forwards
    file.degree = rest.degree;
    readGaussians(input, file, packed ? packedGaussians(input, header) : plainGaussians(input, header), sink);
}

} // namespace pointrt
