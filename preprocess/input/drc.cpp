// SPDX-License-Identifier: GPL-3.0-or-later
// Draco: https://google.github.io/draco/spec/
#include <new>
#include <stdexcept>

#include <draco/compression/config/compression_shared.h>
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include "preprocess/input/readers.h"

namespace pointrt {
namespace {

using draco::GeometryAttribute;
using draco::PointAttribute;

struct Counts {
    std::uint32_t points = 0, faces = 0;
};

/// Counts are fixed 32 bits in bitstreams before 2.0 (edgebreaker) or 2.2 (sequential), variable length since.
bool decodeCount(draco::DecoderBuffer& buffer, std::uint16_t first_variable, std::uint32_t& count) {
    if (buffer.bitstream_version() < first_variable) return buffer.Decode(&count);
    return draco::DecodeVarint(&count, &buffer);
}

bool decodeMeshCounts(draco::DecoderBuffer& buffer, std::uint8_t method, Counts& counts) {
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

/// Reads the file up to its counts of points and faces.
bool decodeCounts(const Source& source, Counts& counts) {
    draco::DecoderBuffer buffer;
    buffer.Init(source.bytes.data(), source.bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return false;
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
    draco::GeometryMetadata ignored;
    const bool has_metadata =
        buffer.bitstream_version() >= DRACO_BITSTREAM_VERSION(1, 3) && (header.flags & METADATA_FLAG_MASK) != 0;
    if (has_metadata && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &ignored)) return false;
    if (header.encoder_type == draco::TRIANGULAR_MESH) return decodeMeshCounts(buffer, header.encoder_method, counts);
    return buffer.Decode(&counts.points);
}

/// The library allocates what the counts promise. Even a flat regular grid takes more than a thousandth of a byte for
/// each point and face.
void checkCounts(const Source& source) {
    constexpr std::uint64_t kLargestGain = 1024;
    Counts counts;
    if (!decodeCounts(source, counts)) refuse(source, "the Draco header is broken or cut short");
    const std::uint64_t most = kLargestGain * source.bytes.size();
    if (counts.points > most || counts.faces > most)
        refuse(source, fmt::format("the header promises {} points and {} faces in {} bytes", counts.points,
                                   counts.faces, source.bytes.size()));
}

/// A mesh is also a point cloud; mesh points to it where it is one.
struct Decoded {
    std::unique_ptr<draco::PointCloud> points;
    const draco::Mesh* mesh = nullptr;
};

Decoded decode(const Source& source) {
    draco::DecoderBuffer buffer;
    buffer.Init(source.bytes.data(), source.bytes.size());
    Decoded decoded;
    std::string reason = "out of bounds";
    try {
        auto result = draco::Decoder().DecodePointCloudFromBuffer(&buffer);
        if (result.ok())
            decoded.points = std::move(result).value();
        else
            reason = result.status().error_msg_string();
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    if (!decoded.points) refuse(source, fmt::format("the Draco data is broken or cut short: {}", quoted(reason)));
    decoded.mesh = dynamic_cast<const draco::Mesh*>(decoded.points.get());
    return decoded;
}

const PointAttribute* attributeOf(const draco::PointCloud& points, GeometryAttribute::Type type) {
    const PointAttribute* const attribute = points.GetNamedAttribute(type);
    return attribute && attribute->num_components() >= 3 ? attribute : nullptr;
}

ColorScale scaleOf(const PointAttribute& colors) {
    if (colors.data_type() == draco::DT_UINT8) return ColorScale::kByte;
    const bool real = colors.data_type() == draco::DT_FLOAT32 || colors.data_type() == draco::DT_FLOAT64;
    return real ? ColorScale::kReal : ColorScale::kInteger;
}

void load(const Source& source, const PointAttribute* attribute, draco::PointIndex point, double* into) {
    if (!attribute) return;
    const draco::AttributeValueIndex value = attribute->mapped_index(point);
    if (value.value() >= attribute->size()) refuse(source, "the Draco data is broken: a value is missing");
    if (attribute->data_type() == draco::DT_UINT8) { // as it is, even where it is marked as a share of 1
        const std::uint8_t* const bytes = attribute->GetAddress(value);
        std::copy(bytes, bytes + 3, into);
    } else if (!attribute->ConvertValue<double>(value, 3, into)) {
        refuse(source, "the Draco data has values that are no numbers");
    }
}

void addVertices(const Source& source, const draco::PointCloud& points, Sink& sink) {
    const PointAttribute* const positions = attributeOf(points, GeometryAttribute::POSITION);
    const PointAttribute* const normals = attributeOf(points, GeometryAttribute::NORMAL);
    const PointAttribute* const colors = attributeOf(points, GeometryAttribute::COLOR);
    if (!positions) refuse(source, "the Draco data has no positions");
    ScanTraits traits;
    traits.vertices = points.num_points();
    traits.normals = normals != nullptr;
    traits.colors = colors != nullptr;
    if (colors) traits.color_scale = scaleOf(*colors);
    beginScan(sink, source, traits);
    Row row{};
    for (draco::PointIndex i(0); i < points.num_points(); ++i) {
        load(source, positions, i, &row[kX]);
        load(source, normals, i, &row[kNormalX]);
        load(source, colors, i, &row[kRed]);
        addVertex(sink, row);
    }
}

void addFaces(const Source& source, const draco::Mesh& mesh, Sink& sink) {
    for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i) {
        const auto& face = mesh.face(i);
        const std::uint32_t corners[] = {face[0].value(), face[1].value(), face[2].value()};
        for (const std::uint32_t corner : corners)
            if (corner >= mesh.num_points())
                refuseAt(source, fmt::format("face {}", i.value()), "vertex index out of range");
        addPolygon(sink, corners);
    }
}

} // namespace

void readDraco(const Source& source, Sink& sink) {
    checkCounts(source);
    const Decoded decoded = decode(source);
    addVertices(source, *decoded.points, sink);
    if (decoded.mesh) addFaces(source, *decoded.mesh, sink);
    finishScan(sink, source);
}

} // namespace pointrt
