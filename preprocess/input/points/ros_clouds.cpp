// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/ros_clouds.h"

#include <algorithm>
#include <optional>

#include "preprocess/ingest/field_arrays.h"
#include "preprocess/ingest/text.h"
#include "preprocess/input/points/byte_cursor.h"

namespace pointrt {
namespace {

/// Takes the members of a message. CDR aligns numbers to their size, counted from behind its header of 4 bytes.
struct RosMessage {
    ByteCursor bytes;
    RosEncoding encoding;
    std::size_t size;

    RosMessage(const InputFile& input, RosEncoding how, std::string_view message)
        : bytes{input, message}, encoding(how), size(message.size()) {
        if (how != RosEncoding::kCdr) return;
        const std::string_view header = bytes.takeBytes(4);
        if (header[1] != '\1' && header[1] != '\0') refuse(input, "has messages in an encoding other than plain CDR");
        if (header[1] == '\0') refuse(input, "has big-endian messages, which this build does not read");
        size -= 4;
    }
    template <typename Value>
    Value take() {
        const std::size_t done = size - bytes.rest.size();
        if (encoding == RosEncoding::kCdr) bytes.takeBytes((sizeof(Value) - done % sizeof(Value)) % sizeof(Value));
        return bytes.take<Value>();
    }
    std::string_view text() {
        std::string_view text = bytes.takeBytes(take<std::uint32_t>());
        while (!text.empty() && text.back() == '\0') text.remove_suffix(1); // CDR ends texts with a 0
        return text;
    }
};

/// PointField's datatype.
std::optional<Scalar> scalarOfField(std::uint8_t type) {
    constexpr Scalar kTypes[] = {Scalar::kI8,  Scalar::kU8,  Scalar::kI16, Scalar::kU16,
                                 Scalar::kI32, Scalar::kU32, Scalar::kF32, Scalar::kF64};
    return type >= 1 && type <= std::size(kTypes) ? std::optional(kTypes[type - 1]) : std::nullopt;
}

struct RosCloud {
    std::string frame;
    std::uint32_t height = 0, width = 0, point_step = 0, row_step = 0;
    std::vector<FieldArray> fields; ///< `first` is null
    std::vector<std::size_t> offsets;
    bool swapped = false;
    std::string_view data;
    std::string packed; ///< the data, if its rows had padding
};

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

/// Rows without the padding between them.
void dropPadding(RosCloud& cloud) {
    const std::size_t row = std::size_t{cloud.width} * cloud.point_step;
    if (cloud.height <= 1 || cloud.row_step == row) return;
    for (std::uint32_t j = 0; j < cloud.height; ++j)
        cloud.packed += cloud.data.substr(std::size_t{j} * cloud.row_step, row);
    cloud.data = cloud.packed;
}

void placeFields(const InputFile& input, RosCloud& cloud) {
    for (std::size_t i = 0; i < cloud.fields.size(); ++i) {
        FieldArray& field = cloud.fields[i];
        if (cloud.offsets[i] + scalarSize(field.type) * std::uint64_t{field.components} > cloud.point_step)
            refuse(input,
                   fmt::format("field {} lies outside its point of {} bytes", inQuotes(field.name), cloud.point_step));
        field.first = cloud.data.data() + cloud.offsets[i];
        field.stride = cloud.point_step;
        field.swapped = cloud.swapped;
    }
}

/// Whether the data is as long as the sizes say.
bool holdsPoints(const RosCloud& cloud) {
    if (cloud.height == 0 || cloud.width == 0) return true;
    const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step,
                        step = cloud.height > 1 ? cloud.row_step : row;
    return cloud.point_step > 0 && step >= row && row <= cloud.data.size() &&
           cloud.height - 1 <= (cloud.data.size() - row) / step;
}

RosCloud takeCloud(const InputFile& input, RosEncoding encoding, std::string_view bytes) {
    RosMessage message(input, encoding, bytes);
    RosCloud cloud;
    if (encoding == RosEncoding::kRos1) message.take<std::uint32_t>(); // seq
    message.take<std::uint32_t>();                                     // stamp: seconds and nanoseconds
    message.take<std::uint32_t>();
    cloud.frame = message.text();
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

/// Whether a frame stays where it is while its scanner moves, by its usual names (REP 105).
bool isFixedFrame(std::string_view frame) {
    const std::string lower = lowerCase(frame);
    for (const std::string_view word : {"map", "odom", "world", "earth", "utm", "global"})
        if (lower.find(word) != std::string::npos) return true;
    return false;
}

} // namespace

bool isRosCloud(std::string_view type) {
    return type == "sensor_msgs/PointCloud2" || type == "sensor_msgs/msg/PointCloud2";
}

void RosClouds::reportLeft(std::size_t bytes) {
    const std::size_t done = input_.bytes.size() - bytes;
    if (progress_) progress_(static_cast<double>(done) / static_cast<double>(input_.bytes.size()));
    release_pages_(done);
}

void RosClouds::add(const std::string& topic, RosEncoding encoding, std::string_view message) {
    RosCloud cloud = takeCloud(input_, encoding, message);
    Topic& its = topics_[topic];
    its.frame = cloud.frame;
    ++its.clouds;
    const std::uint64_t count = std::uint64_t{cloud.height} * cloud.width;
    if (count == 0) return;
    dropPadding(cloud);
    placeFields(input_, cloud);
    findDimensions(cloud.fields);
    if (!hasPositions(cloud.fields))
        refuse(input_, fmt::format("a cloud of topic {} has no fields x, y and z", inQuotes(topic)));
    addFieldPoints(input_, cloud.fields, count, sink_);
    if (!isFixedFrame(cloud.frame)) sink_.setScanSensor(Vec3d::Zero());
    sink_.finishScan(input_, fmt::format("{} {}", topic, its.clouds), Emptiness::kAllowed);
    ++clouds_;
    points_ += count;
}

void RosClouds::cutShort() {
    if (!sink_.salvages) refuse(input_, "truncated: it ends within a record; --salvage reads the clouds before it");
    sink_.note(input_, "truncated: the clouds before its end are read");
}

std::string RosClouds::otherTopics() const {
    std::string others;
    for (const auto& [name, topic] : topics_)
        if (!isRosCloud(topic.type) && others.size() < 80) // about one line
            others += fmt::format("{}{} ({})", others.empty() ? "" : ", ", name, topic.type);
    return others;
}

void RosClouds::finish() {
    if (clouds_ == 0)
        refuse(input_, fmt::format("has no clouds of type sensor_msgs/PointCloud2; its topics are {}",
                                   topics_.empty() ? "none" : inQuotes(otherTopics())));
    std::string read;
    for (const auto& [name, topic] : topics_)
        if (topic.clouds > 0)
            read += fmt::format("{}{} ({} in frame {})", read.empty() ? "" : ", ", name, topic.clouds, topic.frame);
    sink_.note(input_,
               fmt::format("clouds are read as they are, without poses of a moving scanner: {}", inQuotes(read)));
    if (const std::string others = otherTopics(); !others.empty())
        sink_.note(input_, fmt::format("topics without clouds are not read: {}", inQuotes(others)));
    WorldFrame frame;
    frame.up = Vec3d::UnitZ(); // of vehicles and maps alike (REP 103)
    frame.up_by_custom = true;
    frame.metres_per_unit = 1;
    sink_.setWorldFrame(input_, frame);
}

} // namespace pointrt
