// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/gltf_meshes.h"

#include <cmath>

#include "preprocess/cloud/srgb.h"
#include "preprocess/ingest/scan_colors.h"
#include "preprocess/input/mesh/gltf_accessor.h"
#include "preprocess/input/mesh/picture.h"

namespace pointrt {
namespace {

/// The numbers of OpenGL.
enum GltfMode { kModePoints = 0, kModeTriangles = 4, kModeStrip = 5, kModeFan = 6 };

std::uint64_t modeOf(const GltfPart& part) {
    const auto mode = part.primitive.optionalMember("mode");
    return mode ? mode->integer(kModeFan) : std::uint64_t{static_cast<unsigned>(kModeTriangles)};
}

/// A file may show the vertices of one mesh many times: at most this many in all, plus this many for each of its bytes.
constexpr std::uint64_t kVerticesAtLeast = 1 << 24, kVerticesPerByte = 16;

/// Sets of places in textures; files have one or two.
constexpr std::uint64_t kMostTextureSets = 255;

/// The colour of a primitive's material: linear red, green, blue.
struct PartMaterial {
    Vec3d factor = Vec3d::Ones();
    bool has_factor = false;
    std::optional<JsonValue> texture; ///< of the base colour
};

PartMaterial materialOf(const GltfFile& file, const GltfPart& part) {
    PartMaterial material;
    const auto index = part.primitive.optionalMember("material");
    if (!index) return material;
    const auto roughness = file.item("materials", *index).optionalMember("pbrMetallicRoughness");
    if (!roughness) return material;
    material.texture = roughness->optionalMember("baseColorTexture");
    if (const auto factor = roughness->optionalMember("baseColorFactor")) {
        material.has_factor = true;
        for (std::size_t i = 0; i < 3; ++i) material.factor[static_cast<Eigen::Index>(i)] = factor->at(i).number();
    }
    return material;
}

/// The vertices and indices of one primitive.
class PartReader {
public:
    PartReader(const GltfFile& file, const GltfPart& part)
        : file_(file), part_(part), attributes_(part.primitive.member("attributes")),
          positions_(file, attributes_.member("POSITION"), 3), material_(materialOf(file, part)) {
        if (const auto normals = attributes_.optionalMember("NORMAL")) normals_.emplace(file, *normals, 3);
        if (const auto colors = attributes_.optionalMember("COLOR_0")) colors_.emplace(file, *colors, 3, 4);
        if (const auto indices = part.primitive.optionalMember("indices")) indices_.emplace(file, *indices, 1);
        for (const auto* accessor : {&normals_, &colors_})
            if (*accessor && (*accessor)->count() < positions_.count())
                attributes_.refuse(fmt::format("have {} positions, but other values for only {} of them",
                                               positions_.count(), (*accessor)->count()));
        normal_from_part_ = part.input_from_part.linear().inverse().transpose();
        mirrors_ = part.input_from_part.linear().determinant() < 0;
    }

    bool hasNormals() const { return normals_.has_value(); }
    bool hasColors() const { return colors_ || material_.has_factor; }

    /// Opens the texture of faces without colours of their own. If that fails, they have no colours, and a note says
    /// so.
    void openTexture(Sink& sink) {
        if (!material_.texture || colors_ || isOfPoints()) return;
        const auto set = material_.texture->optionalMember("texCoord");
        const std::string name = fmt::format("TEXCOORD_{}", set ? set->integer(kMostTextureSets) : 0);
        const auto places = attributes_.optionalMember(name.c_str());
        if (!places) {
            sink.note(file_.input(), fmt::format("its faces lack the colours of textures: they have no {}", name));
            return;
        }
        try {
            openPicture(sink);
        } catch (const Error& error) { // for example, because a file is missing
            noteUnreadTexture(file_.input(), error, sink);
        }
        if (picture_) places_.emplace(file_, *places, 2);
        if (places_ && places_->count() < positions_.count()) places->refuse("has fewer values than positions");
    }
    bool isOfPoints() const { return modeOf(part_) == kModePoints; }

    /// Points with indices: one for each index.
    std::uint64_t vertexCount() const { return isOfPoints() ? cornerCount() : positions_.count(); }

    /// row: all values of a vertex
    void readVertex(std::uint64_t index, Row& row) const {
        const std::uint64_t vertex = isOfPoints() ? corner(index) : index;
        const Vec3d position = part_.input_from_part * positions_.three(vertex);
        const Vec3d normal = normals_ ? Vec3d(normal_from_part_ * normals_->three(vertex)) : Vec3d(Vec3d::Zero());
        for (int axis = 0; axis < 3; ++axis) {
            row[kX + axis] = position[axis];
            row[kNormalX + axis] = normal[axis];
            row[kRed + axis] = colorOf(vertex, axis);
        }
    }

    /// Adds the triangles. first: index of the part's first vertex in the scan
    void addFaces(std::uint64_t first, Sink& sink) const {
        const std::uint64_t mode = modeOf(part_), corners = cornerCount();
        if (mode == kModeTriangles)
            for (std::uint64_t i = 0; i + 2 < corners; i += 3) addFace(first, {i, i + 1, i + 2}, sink);
        for (std::uint64_t i = 0; mode == kModeStrip && i + 2 < corners; ++i)
            addFace(first, {i, i + 1 + i % 2, i + 2 - i % 2}, sink);
        for (std::uint64_t i = 1; mode == kModeFan && i + 1 < corners; ++i) addFace(first, {0, i, i + 1}, sink);
    }

private:
    void openPicture(Sink& sink) {
        const JsonValue index = material_.texture->member("index");
        const auto picture = file_.picture(index);
        if (picture)
            picture_ =
                addPicture(file_.input(), *picture, fmt::format("{}#{}", file_.input().name, index.integer()), sink);
        else
            sink.note(file_.input(), "has textures in formats of extensions, which are not read");
    }

    std::uint64_t cornerCount() const { return indices_ ? indices_->count() : positions_.count(); }

    /// The vertex of a corner.
    std::uint64_t corner(std::uint64_t index) const {
        if (!indices_) return index;
        const double vertex = indices_->value(index, 0);
        if (!(vertex >= 0 && vertex < static_cast<double>(positions_.count())))
            part_.primitive.refuse(
                fmt::format("vertex index {} is out of range (there are {} vertices)", vertex, positions_.count()));
        return static_cast<std::uint64_t>(vertex);
    }

    /// Adds a face; reverses it in a mirrored part, which would otherwise show its back.
    void addFace(std::uint64_t first, std::array<std::uint64_t, 3> corners, Sink& sink) const {
        if (mirrors_) std::swap(corners[1], corners[2]);
        std::uint32_t face[3] = {};
        std::array<Eigen::Vector2f, 3> places{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint64_t vertex = corner(corners[i]);
            face[i] = static_cast<std::uint32_t>(first + vertex);
            if (places_) places[i] = placeOf(vertex);
        }
        PolygonPaint paint;
        if (places_) paint.picture = *picture_, paint.places = places;
        sink.addPolygon(face, paint);
    }

    /// The place in the texture; here, the first row is the lowest, in glTF the highest.
    Eigen::Vector2f placeOf(std::uint64_t vertex) const {
        return {static_cast<float>(places_->value(vertex, 0)), static_cast<float>(1 - places_->value(vertex, 1))};
    }

    double colorOf(std::uint64_t vertex, int channel) const {
        if (!hasColors()) return kGreyColor[static_cast<std::size_t>(channel)];
        const double linear = material_.factor[channel] * (colors_ ? colors_->value(vertex, channel) : 1);
        return 255 * srgbFromLinear(std::clamp(linear, 0.0, 1.0));
    }

    const GltfFile& file_;
    const GltfPart& part_;
    JsonValue attributes_;
    GltfAccessor positions_;
    std::optional<GltfAccessor> normals_, colors_, indices_, places_;
    std::optional<std::uint32_t> picture_; ///< index in the sink's paint
    PartMaterial material_;
    Eigen::Matrix3d normal_from_part_;
    bool mirrors_ = false;
};

/// Opens all parts, to find the properties that they have together.
ScanTraits traitsOf(const GltfFile& file, const std::vector<GltfPart>& parts) {
    ScanTraits traits;
    traits.faces = false;
    for (const GltfPart& part : parts) {
        const PartReader reader(file, part);
        traits.normals |= reader.hasNormals();
        traits.colors |= reader.hasColors();
        traits.faces |= !reader.isOfPoints();
        traits.vertices += reader.vertexCount();
    }
    if (traits.vertices > kVerticesAtLeast + kVerticesPerByte * file.size())
        refuse(file.input(), fmt::format("has {} vertices in its scene, too many for a file of {} bytes",
                                         traits.vertices, file.size()));
    return traits;
}

} // namespace

GltfShape gltfShape(const GltfPart& part) {
    const std::uint64_t mode = modeOf(part);
    if (mode == kModePoints) return GltfShape::kPoints;
    return mode >= kModeTriangles ? GltfShape::kTriangles : GltfShape::kLines;
}

void readGltfParts(const GltfFile& file, const std::vector<GltfPart>& parts, const std::string& title, Sink& sink) {
    sink.beginScan(file.input(), traitsOf(file, parts));
    Row row{};
    std::uint64_t first = 0;
    for (const GltfPart& part : parts) {
        PartReader reader(file, part);
        reader.openTexture(sink);
        for (std::uint64_t i = 0; i < reader.vertexCount(); ++i) {
            reader.readVertex(i, row);
            sink.addVertex(row);
        }
        reader.addFaces(first, sink);
        first += reader.vertexCount();
    }
    sink.finishScan(file.input(), title);
}

} // namespace pointrt
