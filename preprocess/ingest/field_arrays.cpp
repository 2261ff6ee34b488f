// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/field_arrays.h"

#include <algorithm>
#include <cctype>

#include "preprocess/ingest/attribute_names.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/sink.h"
#include "preprocess/ingest/typed_word.h"

namespace pointrt {
namespace {

/// Names of arrays with a vector for each point.
struct VectorName {
    std::string_view name;
    Dimension dimension;
};
constexpr VectorName kVectorNames[] = {
    {"points", kX},  {"point", kX},      {"xyz", kX},          {"position", kX},      {"positions", kX},
    {"pos", kX},     {"coord", kX},      {"coords", kX},       {"coordinates", kX},   {"vertices", kX},
    {"pts", kX},     {"pointcloud", kX}, {"normal", kNormalX}, {"normals", kNormalX}, {"nxyz", kNormalX},
    {"color", kRed}, {"colors", kRed},   {"colour", kRed},     {"colours", kRed},     {"rgb", kRed},
    {"rgba", kRed},  {"rgbs", kRed},
};

Dimension dimensionOfVector(std::string_view name) {
    std::string lower;
    for (const char letter : name)
        if (letter != '_' && letter != ' ')
            lower += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    for (const VectorName& each : kVectorNames)
        if (each.name == lower) return each.dimension;
    return kIgnored;
}

bool isPackedColor(const FieldArray& field) {
    const bool named = dimensionOfVector(field.name) == kRed;
    return named && field.components == 1 && scalarSize(field.type) == 4;
}

/// The number of components with a dimension: three of a vector, or one.
std::size_t rowComponents(const FieldArray& field) { return field.components >= 3 ? 3 : 1; }

/// A component whose value goes to a row, or a packed colour.
struct RowSource {
    const FieldArray* field;
    std::size_t offset; ///< from the field's first
    Dimension dimension;
};

struct FieldPlan {
    std::vector<RowSource> row;
    std::vector<const FieldArray*> attributes;
    ScanTraits traits;
    std::size_t packed_size = 0;
    std::string unread;
};

void addAttribute(const FieldArray& field, AttributeNames& names, FieldPlan& plan) {
    constexpr std::uint32_t kMostComponents = 4;
    const auto name = field.components <= kMostComponents ? names.take(field.name) : std::nullopt;
    if (!name) return addQuoted(field.name, plan.unread);
    plan.attributes.push_back(&field);
    plan.traits.columns.push_back({*name, field.type, field.components});
    plan.packed_size += scalarSize(field.type) * field.components;
}

ColorScale scaleOf(const FieldArray& field) {
    if (field.packs_color || field.type == Scalar::kU8) return ColorScale::kByte;
    return isReal(field.type) ? ColorScale::kReal : ColorScale::kInteger;
}

FieldPlan planOf(std::span<const FieldArray> fields) {
    FieldPlan plan;
    AttributeNames names;
    for (const FieldArray& field : fields) {
        if (field.packs_color) {
            plan.row.push_back({&field, 0, kRed});
            plan.traits.colors = true;
            plan.traits.color_scale = scaleOf(field);
        } else if (field.dimension == kIgnored) {
            addAttribute(field, names, plan);
        } else {
            for (std::size_t i = 0; i < rowComponents(field); ++i)
                plan.row.push_back({&field, i * field.step, static_cast<Dimension>(field.dimension + i)});
            plan.traits.normals = plan.traits.normals || field.dimension == kNormalX;
            plan.traits.colors = plan.traits.colors || field.dimension == kRed;
            if (field.dimension == kRed) plan.traits.color_scale = scaleOf(field);
        }
    }
    return plan;
}

void packValues(const FieldPlan& plan, std::uint64_t point, char* into) {
    for (const FieldArray* const field : plan.attributes)
        for (std::uint32_t i = 0; i < field->components; ++i) {
            storeBytes(field->first + point * field->stride + i * field->step, field->type, field->swapped, into);
            into += scalarSize(field->type);
        }
}

} // namespace

FieldArray denseField(const std::string& name, Scalar type, std::uint32_t components, const char* first) {
    return {name, type, components, first, scalarSize(type) * components, scalarSize(type)};
}

void findDimensions(std::span<FieldArray> fields) {
    std::vector<Dimension> dimensions;
    for (const FieldArray& field : fields) {
        const Dimension vector = field.components >= 3 ? dimensionOfVector(field.name) : kIgnored;
        const Dimension single = field.components == 1 ? dimensionOfName(field.name) : kIgnored;
        dimensions.push_back(vector == kIgnored ? single : vector);
        if (vector != kIgnored) // stands for all three dimensions
            dimensions.insert(dimensions.end(),
                              {static_cast<Dimension>(vector + 1), static_cast<Dimension>(vector + 2)});
    }
    resolveDimensions(dimensions);
    const bool packs = !pointrt::hasColors(dimensions);
    std::size_t at = 0;
    for (FieldArray& field : fields) {
        const bool is_vector = field.components >= 3 && dimensionOfVector(field.name) != kIgnored;
        field.dimension = dimensions[at];
        at += is_vector ? 3 : 1;
        field.packs_color = packs && field.dimension == kIgnored && isPackedColor(field);
    }
}

bool hasPositions(std::span<const FieldArray> fields) {
    std::vector<Dimension> dimensions;
    for (const FieldArray& field : fields)
        for (std::size_t i = 0; i < rowComponents(field) && field.dimension != kIgnored; ++i)
            dimensions.push_back(static_cast<Dimension>(field.dimension + i));
    return hasPositions(std::span<const Dimension>(dimensions));
}

void beginFieldScan(const InputFile& input, std::span<const FieldArray> fields, std::uint64_t count, Sink& sink,
                    bool faces) {
    FieldPlan plan = planOf(fields);
    if (!plan.unread.empty())
        sink.note(input, "fields with more than 4 components or a duplicate name are not read: " + plan.unread);
    plan.traits.vertices = count;
    plan.traits.faces = faces;
    sink.beginScan(input, plan.traits);
}

void addToFieldScan(std::span<const FieldArray> fields, std::uint64_t count, Sink& sink) {
    const FieldPlan plan = planOf(fields);
    Row row{};
    std::vector<char> packed(plan.packed_size);
    for (std::uint64_t i = 0; i < count; ++i) {
        for (const RowSource& source : plan.row) {
            const char* const at = source.field->first + i * source.field->stride + source.offset;
            if (source.field->packs_color)
                setPackedColor(row, static_cast<std::uint32_t>(loadScalar(at, Scalar::kU32, source.field->swapped)));
            else
                row[source.dimension] = loadScalar(at, source.field->type, source.field->swapped);
        }
        packValues(plan, i, packed.data());
        sink.addVertex(row, packed.data());
    }
}

void addFieldPoints(const InputFile& input, std::span<const FieldArray> fields, std::uint64_t count, Sink& sink,
                    bool faces) {
    beginFieldScan(input, fields, count, sink, faces);
    addToFieldScan(fields, count, sink);
}

} // namespace pointrt
