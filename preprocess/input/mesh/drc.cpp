// SPDX-License-Identifier: GPL-3.0-or-later
// Draco: https://google.github.io/draco/spec/
#include <algorithm>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>

#include <draco/compression/config/compression_shared.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/compression/point_cloud/point_cloud_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include "preprocess/ingest/attribute_names.h"
#include "preprocess/ingest/formats.h"
#include "preprocess/input/mesh/drc.h"
#include "preprocess/input/mesh/drc_guard.h"

namespace pointrt {
namespace {

using draco::GeometryAttribute;
using draco::PointAttribute;

struct MeshCounts {
    std::uint32_t points = 0, faces = 0;
};

/// Counts are fixed 32 bits in bitstreams before 2.0 (edgebreaker) or 2.2 (sequential), variable length since.
bool decodeCount(draco::DecoderBuffer& buffer, std::uint16_t first_variable, std::uint32_t& count) {
    if (buffer.bitstream_version() < first_variable) return buffer.Decode(&count);
    return draco::DecodeVarint(&count, &buffer);
}

bool decodeMeshCounts(draco::DecoderBuffer& buffer, std::uint8_t method, MeshCounts& counts) {
    if (method == draco::MESH_SEQUENTIAL_ENCODING) {
        constexpr std::uint16_t kVariable = DRACO_BITSTREAM_VERSION(2, 2);
        return decodeCount(buffer, kVariable, counts.faces) && decodeCount(buffer, kVariable, counts.points);
    }
    constexpr std::uint16_t kVariable = DRACO_BITSTREAM_VERSION(2, 0);
    std::uint8_t traversal = 0;
    std::uint32_t split_vertices = 0;
    if (!buffer.Decode(&traversal)) return false;
    if (buffer.bitstream_version() < DRACO_BITSTREAM_VERSION(2, 2) && !decodeCount(buffer, kVariable, split_vertices))
        return false;
    return decodeCount(buffer, kVariable, counts.points) && decodeCount(buffer, kVariable, counts.faces);
}

/// Advances the buffer past the header.
draco::DracoHeader decodeHeader(const InputFile& input, draco::DecoderBuffer& buffer) {
    buffer.Init(input.bytes.data(), input.bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() || header.encoder_method > 1)
        refuse(input, "the Draco header is invalid or truncated");
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
    return header;
}

/// Reads the file up to its counts of points and faces.
bool decodeCounts(const InputFile& input, MeshCounts& counts) {
    draco::DecoderBuffer buffer;
    const draco::DracoHeader header = decodeHeader(input, buffer);
    draco::GeometryMetadata ignored;
    const bool has_metadata =
        buffer.bitstream_version() >= DRACO_BITSTREAM_VERSION(1, 3) && (header.flags & METADATA_FLAG_MASK) != 0;
    if (has_metadata && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &ignored)) return false;
    if (header.encoder_type == draco::TRIANGULAR_MESH) return decodeMeshCounts(buffer, header.encoder_method, counts);
    return buffer.Decode(&counts.points);
}

/// The library allocates memory for as many points as a file declares. A file may declare this many, plus sixteen
/// points for each of its bytes: the best compressed regular grid has seven points per byte.
constexpr std::uint64_t kPointsAtLeast = 1 << 20, kPointsPerByte = 16;
constexpr std::uint64_t kBytesPerPoint = 64;

bool promisesTooMuch(std::uint64_t points, std::size_t file_size) {
    return points > kPointsAtLeast + kPointsPerByte * file_size;
}

void checkCounts(const InputFile& input) {
    MeshCounts counts;
    if (!decodeCounts(input, counts)) refuse(input, "the Draco header is invalid or truncated");
    if (promisesTooMuch(counts.points, input.bytes.size()) || promisesTooMuch(counts.faces, input.bytes.size()))
        refuse(input, fmt::format("the header promises {} points and {} faces in {} bytes", counts.points, counts.faces,
                                  input.bytes.size()));
}

/// A decoder of the library that checks the size of attributes before decoding them.
template <typename Decoder>
struct Guarded : GuardedAttributes<Decoder> {
    std::size_t file_size = 0;

protected:
    bool DecodeAllAttributes() override {
        const draco::PointCloud& cloud = *this->point_cloud();
        std::uint64_t point_size = 0;
        for (int i = 0; i < cloud.num_attributes(); ++i)
            point_size += static_cast<std::uint64_t>(cloud.attribute(i)->byte_stride());
        const std::uint64_t points = point_size * cloud.num_points() / kBytesPerPoint;
        return !promisesTooMuch(points, file_size) && Decoder::DecodeAllAttributes();
    }
};

/// If the points are a mesh, `mesh` points to `points`.
struct Decoded {
    std::unique_ptr<draco::PointCloud> points;
    const draco::Mesh* mesh = nullptr;
};

template <typename Decoder, typename Geometry>
draco::Status decodeInto(const InputFile& input, Geometry& geometry) {
    draco::DecoderBuffer buffer;
    buffer.Init(input.bytes.data(), input.bytes.size());
    Guarded<Decoder> decoder;
    decoder.file_size = input.bytes.size();
    try {
        return decoder.Decode(draco::DecoderOptions(), &buffer, &geometry);
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    return draco::Status(draco::Status::DRACO_ERROR, "impossible sizes");
}

Decoded decode(const InputFile& input) {
    draco::DecoderBuffer ignored;
    const draco::DracoHeader header = decodeHeader(input, ignored);
    Decoded decoded;
    draco::Status status;
    if (header.encoder_type == draco::TRIANGULAR_MESH) {
        auto mesh = std::make_unique<draco::Mesh>();
        const bool sequential = header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING;
        status = sequential ? decodeInto<draco::MeshSequentialDecoder>(input, *mesh)
                            : decodeInto<draco::MeshEdgebreakerDecoder>(input, *mesh);
        decoded.mesh = mesh.get();
        decoded.points = std::move(mesh);
    } else {
        decoded.points = std::make_unique<draco::PointCloud>();
        const bool sequential = header.encoder_method == draco::POINT_CLOUD_SEQUENTIAL_ENCODING;
        status = sequential ? decodeInto<draco::PointCloudSequentialDecoder>(input, *decoded.points)
                            : decodeInto<draco::PointCloudKdTreeDecoder>(input, *decoded.points);
    }
    if (!status.ok())
        refuse(input, fmt::format("the Draco data is invalid or truncated: {}", inQuotes(status.error_msg_string())));
    return decoded;
}

const PointAttribute* attributeOf(const draco::PointCloud& points, GeometryAttribute::Type type) {
    const PointAttribute* const attribute = points.GetNamedAttribute(type);
    return attribute && attribute->num_components() >= 3 ? attribute : nullptr;
}

struct Roles {
    const PointAttribute* positions = nullptr;
    const PointAttribute* normals = nullptr;
    const PointAttribute* colors = nullptr;
};

/// Finds attributes by their types, or by the ids that the surrounding file gives.
Roles rolesOf(const draco::PointCloud& points, const DracoIds& ids) {
    const auto byId = [&](const std::optional<std::uint32_t>& id) -> const PointAttribute* {
        const PointAttribute* const attribute = id ? points.GetAttributeByUniqueId(*id) : nullptr;
        return attribute && attribute->num_components() >= 3 ? attribute : nullptr;
    };
    Roles roles{attributeOf(points, GeometryAttribute::POSITION), attributeOf(points, GeometryAttribute::NORMAL),
                attributeOf(points, GeometryAttribute::COLOR)};
    if (!roles.normals) roles.normals = byId(ids.normals);
    if (!roles.colors) roles.colors = byId(ids.colors);
    return roles;
}

ColorScale scaleOf(const PointAttribute& colors) {
    if (colors.data_type() == draco::DT_UINT8) return ColorScale::kByte;
    if (colors.data_type() == draco::DT_UINT16) return ColorScale::k16Bit;
    const bool real = colors.data_type() == draco::DT_FLOAT32 || colors.data_type() == draco::DT_FLOAT64;
    return real ? ColorScale::kReal : ColorScale::kInteger;
}

std::optional<Scalar> scalarOf(draco::DataType type) {
    switch (type) {
    case draco::DT_INT8:
        return Scalar::kI8;
    case draco::DT_UINT8:
    case draco::DT_BOOL:
        return Scalar::kU8;
    case draco::DT_INT16:
        return Scalar::kI16;
    case draco::DT_UINT16:
        return Scalar::kU16;
    case draco::DT_INT32:
        return Scalar::kI32;
    case draco::DT_UINT32:
        return Scalar::kU32;
    case draco::DT_INT64:
        return Scalar::kI64;
    case draco::DT_UINT64:
        return Scalar::kU64;
    case draco::DT_FLOAT32:
        return Scalar::kF32;
    case draco::DT_FLOAT64:
        return Scalar::kF64;
    default:
        return std::nullopt;
    }
}

/// The name that the writer gave an attribute, or its number.
std::string nameOf(const draco::PointCloud& points, int id) {
    std::string name;
    const draco::AttributeMetadata* const metadata = points.GetAttributeMetadataByAttributeId(id);
    if (metadata && metadata->GetEntryString("name", &name) && !name.empty()) return name;
    return fmt::format("generic_{}", points.attribute(id)->unique_id());
}

/// Attributes to pack one after the other, `bytes` of each.
struct PackedColumns {
    struct Column {
        const PointAttribute* attribute;
        std::size_t bytes;
    };
    std::vector<Column> columns;
    std::vector<ColumnTraits> traits;
    std::size_t size = 0;
    std::string unread;

    void add(const PointAttribute& attribute, const std::string& name, Scalar type, std::uint32_t components) {
        columns.push_back({&attribute, scalarSize(type) * components});
        traits.push_back({name, type, components});
        size += columns.back().bytes;
    }
};

/// 16-bit colours and generic attributes; texture coordinates of meshes are left out.
PackedColumns packedColumns(const draco::PointCloud& points, const Roles& roles, bool mesh) {
    constexpr std::uint32_t kMostComponents = 4;
    PackedColumns packed;
    AttributeNames names;
    const PointAttribute* const colors = roles.colors;
    if (colors && scaleOf(*colors) == ColorScale::k16Bit) packed.add(*colors, *names.take(kRgb16), Scalar::kU16, 3);
    for (int id = 0; id < points.num_attributes(); ++id) {
        const PointAttribute& attribute = *points.attribute(id);
        const GeometryAttribute::Type type = attribute.attribute_type();
        const bool of_texture = mesh && type == GeometryAttribute::TEX_COORD;
        const bool has_role = type != GeometryAttribute::GENERIC && &attribute == points.GetNamedAttribute(type) &&
                              type != GeometryAttribute::TEX_COORD;
        const bool is_named = &attribute == roles.normals || &attribute == roles.colors;
        if (has_role || is_named || of_texture) continue;
        const auto components = static_cast<std::uint32_t>(attribute.num_components());
        const std::optional<Scalar> scalar = scalarOf(attribute.data_type());
        const std::string written = nameOf(points, id);
        const auto name =
            scalar && components >= 1 && components <= kMostComponents ? names.take(written) : std::nullopt;
        if (name)
            packed.add(attribute, *name, *scalar, components);
        else
            addQuoted(written, packed.unread);
    }
    return packed;
}

draco::AttributeValueIndex valueOf(const InputFile& input, const PointAttribute& attribute, draco::PointIndex point) {
    const draco::AttributeValueIndex value = attribute.mapped_index(point);
    if (value.value() >= attribute.size()) refuse(input, "the Draco data is invalid: a value is missing");
    return value;
}

void pack(const InputFile& input, const PackedColumns& packed, draco::PointIndex point, char* into) {
    for (const PackedColumns::Column& column : packed.columns) {
        std::memcpy(into, column.attribute->GetAddress(valueOf(input, *column.attribute, point)), column.bytes);
        into += column.bytes;
    }
}

void load(const InputFile& input, const PointAttribute* attribute, draco::PointIndex point, double* into) {
    if (!attribute) return;
    const draco::AttributeValueIndex value = valueOf(input, *attribute, point);
    const std::uint8_t* const bytes = attribute->GetAddress(value);
    if (attribute->data_type() == draco::DT_UINT8) { // unchanged, even if marked as normalised
        std::copy(bytes, bytes + 3, into);
    } else if (attribute->data_type() == draco::DT_BOOL) { // the library loads any byte as a bool
        std::transform(bytes, bytes + 3, into, [](std::uint8_t byte) { return byte != 0; });
    } else if (!attribute->ConvertValue<double>(value, 3, into)) {
        refuse(input, "the Draco data has values that are not numbers");
    }
}

void addVertices(const InputFile& input, const draco::PointCloud& points, const Roles& roles, bool mesh, Sink& sink) {
    const auto& [positions, normals, colors] = roles;
    if (!positions) refuse(input, "the Draco data has no positions");
    ScanTraits traits;
    traits.vertices = points.num_points();
    traits.normals = normals != nullptr;
    traits.colors = colors != nullptr;
    traits.faces = mesh;
    if (colors) traits.color_scale = scaleOf(*colors);
    const PackedColumns packed = packedColumns(points, roles, mesh);
    traits.columns = packed.traits;
    if (!packed.unread.empty())
        sink.note(input, "attributes with more than 4 components or a duplicate name are not read: " + packed.unread);
    sink.beginScan(input, traits);
    Row row{};
    std::vector<char> values(packed.size);
    for (draco::PointIndex i(0); i < points.num_points(); ++i) {
        load(input, positions, i, &row[kX]);
        load(input, normals, i, &row[kNormalX]);
        load(input, colors, i, &row[kRed]);
        pack(input, packed, i, values.data());
        sink.addVertex(row, values.data());
    }
}

void addFaces(const InputFile& input, const draco::Mesh& mesh, Sink& sink) {
    for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i) {
        const auto& face = mesh.face(i);
        const std::uint32_t corners[] = {face[0].value(), face[1].value(), face[2].value()};
        for (const std::uint32_t corner : corners)
            if (corner >= mesh.num_points())
                refuseAt(input, fmt::format("face {}", i.value()), "vertex index out of range");
        sink.addPolygon(corners);
    }
}

bool isDracoStart(std::string_view bytes) { return bytes.starts_with("DRACO"); }

void readDraco(const InputFile& input, Sink& sink) {
    addDraco(input, {}, sink);
    sink.finishScan(input);
}

} // namespace

void addDraco(const InputFile& input, const DracoIds& ids, Sink& sink) {
    checkCounts(input);
    const Decoded decoded = decode(input);
    addVertices(input, *decoded.points, rolesOf(*decoded.points, ids), decoded.mesh != nullptr, sink);
    if (decoded.mesh) addFaces(input, *decoded.mesh, sink);
}

const FormatReader readers::kDraco{.isStart = isDracoStart, .read = readDraco};

} // namespace pointrt
