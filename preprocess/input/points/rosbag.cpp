// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings of ROS 1: http://wiki.ros.org/Bags/Format/2.0
#include <cstring>
#include <unordered_map>

#include "preprocess/input/points/byte_cursor.h"
#include "preprocess/input/points/ros_clouds.h"
#include "preprocess/input/points/unpack_chunk.h"

namespace pointrt {
namespace {

constexpr std::string_view kBagMark = "#ROSBAG V2.0\n";

enum BagRecord : std::uint8_t { kMessageData = 2, kChunkRecord = 5, kConnection = 7 };

/// Fields "name=value" of a header.
class BagHeader {
public:
    BagHeader(const InputFile& input, std::string_view bytes) : input_(input) {
        ByteCursor cursor{input, bytes};
        while (!cursor.rest.empty()) {
            const std::string_view field = cursor.takeText();
            const std::size_t equals = field.find('=');
            if (equals == std::string_view::npos) refuse(input, "a field of a record has no name");
            fields_[std::string(field.substr(0, equals))] = field.substr(equals + 1);
        }
    }
    std::string_view text(const char* name) const {
        const auto found = fields_.find(name);
        return found == fields_.end() ? std::string_view() : found->second;
    }
    template <typename Number>
    Number number(const char* name) const {
        ByteCursor cursor{input_, text(name)};
        return cursor.take<Number>();
    }

private:
    const InputFile& input_;
    std::unordered_map<std::string, std::string_view> fields_;
};

class BagReader {
public:
    BagReader(const InputFile& input, Sink& sink) : input_(input), clouds_(input, sink) {}

    void read() {
        if (mayHavePoses()) {
            clouds_.beginPoses();
            readRecords(records(), false);
        }
        topic_of_connection_.clear();
        clouds_.beginClouds();
        readRecords(records(), false);
        clouds_.finish();
    }

private:
    std::string_view records() const { return input_.bytes.substr(kBagMark.size()); }

    /// Whether a topic of the index has poses. A bag without an index may have any.
    bool mayHavePoses() const {
        ByteCursor cursor{input_, records()};
        std::string_view header, data;
        if (!takePart(cursor, header)) return true;
        std::uint64_t index = 0;
        const BagHeader first(input_, header);
        if (const std::string_view place = first.text("index_pos"); place.size() == sizeof index)
            std::memcpy(&index, place.data(), sizeof index);
        if (index < kBagMark.size() || index >= input_.bytes.size()) return true;
        cursor.rest = input_.bytes.substr(index);
        bool is_indexed = false;
        while (takePart(cursor, header) && takePart(cursor, data)) {
            if (BagHeader(input_, header).number<std::uint8_t>("op") != kConnection) continue;
            if (RosPoses::hasPoses(BagHeader(input_, data).text("type"))) return true;
            is_indexed = true;
        }
        return !is_indexed;
    }

    void readRecords(std::string_view bytes, bool in_chunk) {
        ByteCursor cursor{input_, bytes};
        while (!cursor.rest.empty()) {
            if (!in_chunk) clouds_.reportLeft(cursor.rest.size());
            std::string_view header, data;
            if (!takePart(cursor, header) || !takePart(cursor, data)) return clouds_.cutShort();
            readRecord(BagHeader(input_, header), data, in_chunk);
        }
    }

    /// A length and as many bytes; false if some are missing.
    static bool takePart(ByteCursor& cursor, std::string_view& part) {
        std::uint32_t size = 0;
        if (cursor.rest.size() < sizeof size) return false;
        std::memcpy(&size, cursor.rest.data(), sizeof size);
        if (size > cursor.rest.size() - sizeof size) return false;
        part = cursor.takeText();
        return true;
    }

    void readRecord(const BagHeader& header, std::string_view data, bool in_chunk) {
        const auto kind = header.number<std::uint8_t>("op");
        if (kind == kConnection) addConnection(header, data);
        if (kind == kMessageData) addMessage(header, data);
        if (kind == kChunkRecord && !in_chunk) readBagChunk(header, data);
    }

    void addConnection(const BagHeader& header, std::string_view data) {
        const std::string topic(header.text("topic")), type(BagHeader(input_, data).text("type"));
        clouds_.addTopic(topic, type);
        if (clouds_.wants(type)) topic_of_connection_[header.number<std::uint32_t>("conn")] = topic;
    }

    void addMessage(const BagHeader& header, std::string_view data) {
        const auto topic = topic_of_connection_.find(header.number<std::uint32_t>("conn"));
        if (topic != topic_of_connection_.end()) clouds_.add(topic->second, RosEncoding::kRos1, data);
    }

    void readBagChunk(const BagHeader& header, std::string_view data) {
        const std::string_view compression = header.text("compression");
        if (compression == "none") return readRecords(data, true);
        readRecords(unpackChunk(input_, compression, data, header.number<std::uint32_t>("size")), true);
    }

    const InputFile& input_;
    RosClouds clouds_;
    std::unordered_map<std::uint32_t, std::string> topic_of_connection_; ///< those that are read
};

bool isRosbag(std::string_view bytes) { return bytes.starts_with("#ROSBAG V"); }

void readRosbag(const InputFile& input, Sink& sink) {
    if (!input.bytes.starts_with(kBagMark)) refuse(input, "is not a ROS bag of version 2.0; 'rosbag fix' converts it");
    BagReader(input, sink).read();
}

} // namespace

const FormatReader readers::kRosbag{.isStart = isRosbag, .read = readRosbag, .readsInBatches = alwaysInBatches};

} // namespace pointrt
