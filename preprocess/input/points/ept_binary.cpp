// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/ept_binary.h"

#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/sink.h"

namespace pointrt {
namespace {

Scalar typeOfDimension(const JsonValue& dimension) {
    struct Type {
        std::string_view type;
        std::uint64_t size;
        Scalar scalar;
    };
    constexpr Type kTypes[] = {
        {"signed", 1, Scalar::kI8},    {"signed", 2, Scalar::kI16},   {"signed", 4, Scalar::kI32},
        {"signed", 8, Scalar::kI64},   {"unsigned", 1, Scalar::kU8},  {"unsigned", 2, Scalar::kU16},
        {"unsigned", 4, Scalar::kU32}, {"unsigned", 8, Scalar::kU64}, {"float", 4, Scalar::kF32},
        {"float", 8, Scalar::kF64},    {"floating", 4, Scalar::kF32}, {"floating", 8, Scalar::kF64}};
    const std::string& type = dimension.member("type").text();
    const std::uint64_t size = dimension.member("size").integer();
    for (const Type& each : kTypes)
        if (each.type == type && each.size == size) return each.scalar;
    dimension.refuse(fmt::format("has type {} of {} bytes", inQuotes(type), size));
}

} // namespace

EptRecords::EptRecords(const InputFile& input, const JsonValue& schema) : input_(input) {
    std::vector<FieldArray> arrays;
    for (std::size_t i = 0; i < schema.size(); ++i) {
        const JsonValue dimension = schema.at(i);
        Field field;
        field.array = denseField(dimension.member("name").text(), typeOfDimension(dimension), 1, nullptr);
        field.at = record_bytes_;
        if (const auto scale = dimension.optionalMember("scale")) field.scale = scale->number();
        if (const auto offset = dimension.optionalMember("offset")) field.offset = offset->number();
        record_bytes_ += scalarSize(field.array.type);
        arrays.push_back(field.array);
        fields_.push_back(field);
    }
    findDimensions(arrays);
    if (!hasPositions(arrays)) schema.refuse("has no dimensions X, Y and Z");
    for (std::size_t i = 0; i < arrays.size(); ++i) fields_[i].array.dimension = arrays[i].dimension;
}

void EptRecords::add(const InputFile& part, std::string_view bytes, Sink& sink) {
    if (bytes.size() % record_bytes_ != 0)
        refuse(part, fmt::format("truncated: its {} bytes are not records of {}", bytes.size(), record_bytes_));
    const std::uint64_t points = bytes.size() / record_bytes_;
    if (points == 0) return;
    std::deque<std::vector<double>> decoded; // scaled values
    std::vector<FieldArray> arrays;
    for (const Field& field : fields_) {
        FieldArray array = field.array;
        array.first = bytes.data() + field.at;
        array.stride = record_bytes_;
        if (field.isScaled()) {
            std::vector<double>& values = decoded.emplace_back(points);
            for (std::uint64_t i = 0; i < points; ++i)
                values[i] = field.offset + field.scale * loadScalar(array.first + i * record_bytes_, array.type, false);
            array = denseField(array.name, Scalar::kF64, 1, reinterpret_cast<const char*>(values.data()));
            array.dimension = field.array.dimension;
        }
        arrays.push_back(array);
    }
    if (!begun_) beginFieldScan(input_, arrays, 0, sink);
    begun_ = true;
    addToFieldScan(arrays, points, sink);
}

} // namespace pointrt
