// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/ros_cloud.h"

#include <algorithm>
#include <optional>

namespace pointrt {
namespace {

/// PointField's datatype.
std::optional<Scalar> scalarOfField(std::uint8_t type) {
    constexpr Scalar kTypes[] = {Scalar::kI8,  Scalar::kU8,  Scalar::kI16, Scalar::kU16,
                                 Scalar::kI32, Scalar::kU32, Scalar::kF32, Scalar::kF64};
    return type >= 1 && type <= std::size(kTypes) ? std::optional(kTypes[type - 1]) : std::nullopt;
}

void takeFields(RosMessage& message, RosCloud& cloud) {
    const InputFile& input = message.bytes.input;
    const auto count = message.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string name(message.text());
        const auto offset = message.take<std::uint32_t>();
        const auto type = scalarOfField(message.take<std::uint8_t>());
        const auto components = std::max<std::uint32_t>(1, message.take<std::uint32_t>());
        if (!type) refuse(input, fmt::format("field {} has an unknown type", inQuotes(name)));
        cloud.fields.push_back(denseField(name, *type, components, nullptr));
        cloud.offsets.push_back(offset);
    }
}

/// Removes the padding between rows.
void dropPadding(RosCloud& cloud) {
    const std::size_t row = std::size_t{cloud.width} * cloud.point_step;
    if (cloud.height <= 1 || cloud.row_step == row) return;
    for (std::uint32_t j = 0; j < cloud.height; ++j)
        cloud.packed += cloud.data.substr(std::size_t{j} * cloud.row_step, row);
    cloud.data = cloud.packed;
}

/// Whether the data has the length that the sizes give.
bool holdsPoints(const RosCloud& cloud) {
    if (cloud.height == 0 || cloud.width == 0) return true;
    const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step,
                        step = cloud.height > 1 ? cloud.row_step : row;
    return cloud.point_step > 0 && step >= row && row <= cloud.data.size() &&
           cloud.height - 1 <= (cloud.data.size() - row) / step;
}

} // namespace

void placeFields(const InputFile& input, RosCloud& cloud) {
    dropPadding(cloud);
    for (std::size_t i = 0; i < cloud.fields.size(); ++i) {
        FieldArray& field = cloud.fields[i];
        if (cloud.offsets[i] + scalarSize(field.type) * std::uint64_t{field.components} > cloud.point_step)
            refuse(input,
                   fmt::format("field {} lies outside its point of {} bytes", inQuotes(field.name), cloud.point_step));
        field.first = cloud.data.data() + cloud.offsets[i];
        field.stride = cloud.point_step;
        field.swapped = cloud.swapped;
    }
    findDimensions(cloud.fields);
}

RosCloud takeRosCloud(const InputFile& input, RosEncoding encoding, std::string_view bytes) {
    RosMessage message(input, encoding, bytes);
    RosCloud cloud;
    cloud.header = RosHeader(message);
    cloud.height = message.take<std::uint32_t>();
    cloud.width = message.take<std::uint32_t>();
    takeFields(message, cloud);
    cloud.swapped = message.take<std::uint8_t>() != 0;
    cloud.point_step = message.take<std::uint32_t>();
    cloud.row_step = message.take<std::uint32_t>();
    cloud.data = message.bytes.takeBytes(message.take<std::uint32_t>());
    if (!holdsPoints(cloud))
        refuse(input, fmt::format("a cloud promises {} x {} points of {} bytes, but has {} bytes", cloud.height,
                                  cloud.width, cloud.point_step, cloud.data.size()));
    return cloud;
}

} // namespace pointrt
